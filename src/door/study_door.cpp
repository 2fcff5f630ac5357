#include "door/door.hpp"
#include "hbvm/study.hpp"
#include "long_work/json.hpp"
#include "study/study.hpp"

namespace hbvm {

Study study(const StudyRequest& door) {
  const core::Admitted admitted(door.stop);
  core::StudyOptions options;
  options.draw = door.draw;
  options.check = door.check;
  options.jobs = door.jobs;
  options.progress = door.progress;
  if (!door.out.empty()) options.out = door.out;
  const auto outcomes = core::run_studies({{door.folder, core::Precision::parse(door.precision)}}, options);
  return *outcomes.front();
}

std::string to_json(const Study& study) {
  return core::dumped({{"title", study.title},
                       {"agreed", study.agreed},
                       {"stated", study.stated},
                       {"complaints", study.complaints},
                       {"files", study.files},
                       {"warnings", study.warnings},
                       {"table", study.table}},
                      2);
}

}  // namespace hbvm

#include "compare/comparison.hpp"
#include "door/door.hpp"
#include "hbvm/results.hpp"
#include "long_work/json.hpp"

namespace hbvm {

Comparison compare_results(const ResultsRequest& door) {
  const core::Admitted admitted(door.stop);
  if (door.files.empty()) throw InputError("no results to compare are named");
  core::ComparisonRequest request;
  request.scene = core::scene_of(door.scene);
  request.files = door.files;
  for (ResultsFile& file : request.files) {
    file.step_given = !file.step.empty();
    if (!file.step_given) file.step = core::step_stored(file.csv, "");
  }
  request.map = door.map;
  request.progress = core::watched(door.progress);
  return core::compare_with_reference(request);
}

std::string to_json(const Comparison& against) {
  core::OrderedJson j{{"digits", against.digits}, {"files", core::OrderedJson::array()}};
  for (const FileComparison& file : against.files) {
    core::OrderedJson entry{{"name", file.name}, {"t", file.times}, {"unused", file.unused}};
    entry["start"] = file.has_start ? core::OrderedJson::array() : core::OrderedJson(nullptr);
    for (const StartDifference& d : file.start)
      entry["start"].push_back({{"name", d.name}, {"theirs", d.theirs}, {"scene", d.ours}});
    for (const ComponentDigits& c : file.components) entry["right_digits"][c.name] = c.digits;
    entry["log10_H_drift"] = file.H_drift;
    entry["log10_g_drift"] = file.g_drift;
    entry["step"] = file.step;
    entry["reference"] = file.stored ? "stored" : "computed now";
    j["files"].push_back(entry);
  }
  j["by_growth"] = against.by_growth;
  j["orders"] = core::OrderedJson::array();
  j["order_between"] = core::OrderedJson::array();
  for (const OrderBetween& c : against.orders) {
    j["orders"].push_back(c.order);
    j["order_between"].push_back({against.files[c.coarse].name, against.files[c.fine].name});
  }
  return core::dumped(j, 2);
}

}  // namespace hbvm

#include "run/trajectory_metadata.hpp"

#include "hbvm/version.hpp"

namespace hbvm::core {

CsvMetadata trajectory_metadata(const RunRequest& request, const std::vector<TrajectoryColumn>& columns,
                                const std::string& command, long every) {
  CsvMetadata metadata{request.scene.title, write_scene(request.scene), {}, {}};
  metadata.properties = {{"version", version()},
                         {"command", command},
                         {"scene", request.scene.name},
                         {"method", request.method->text()},
                         {"solver", std::string(name_of(request.solver))},
                         {"precision", request.precision.name()},
                         {"step", request.step.text()},
                         {"until", request.until.text()},
                         {"every", std::to_string(every)}};
  if (request.direction == Direction::backward) metadata.properties.emplace_back("reverse", "true");
  if (request.start) metadata.properties.emplace_back("start", request.start->file);
  const bool in_double = request.precision.kind() == Precision::Kind::binary64;
  for (const TrajectoryColumn& column : columns)
    metadata.columns.push_back({column.name, in_double ? CsvType::binary64 : CsvType::decimal, column.description});
  return metadata;
}

}  // namespace hbvm::core

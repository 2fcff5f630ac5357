#pragma once

#include <filesystem>
#include <functional>

#include "hbvm/analysis/study.hpp"
#include "hbvm/method/method_name.hpp"
#include "hbvm/report/table.hpp"
#include "hbvm/scene/scene.hpp"
#include "scene/toml_table.hpp"

namespace hbvm {

/// What the kinds of a study are run with. Each kind takes its own keys of study.toml.
struct Experiment {
  std::filesystem::path folder;
  Scene scene;  ///< empty for a study of all scenes
  Precision precision;
  bool check;                                ///< compare with expected.csv
  std::function<void(long, long)> progress;  ///< (runs done, runs in all)
};

/// What comes out: columns and groups of the table, and the comparison.
struct Findings {
  Table table;
  Agreement agreement;
};

Findings halving_study(const Experiment& experiment, TomlTable& top);
Findings long_run_study(const Experiment& experiment, TomlTable& top);
Findings conservation_study(const Experiment& experiment, TomlTable& top);

/// The method that a table of study.toml names.
inline MethodName stated_method(TomlTable& reader) {
  const MethodName method = MethodName::parse(reader.string("method"));
  if (method.is_auto()) reader.fail("a study states its k");
  return method;
}

}  // namespace hbvm

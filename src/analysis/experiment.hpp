#pragma once

#include <filesystem>
#include <functional>

#include "hbvm/analysis/study.hpp"
#include "hbvm/report/table.hpp"
#include "hbvm/scene/scene.hpp"
#include "hbvm/step/hbvm_method.hpp"
#include "hbvm/step/registry.hpp"
#include "toml/toml_table.hpp"

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
inline MethodPtr stated_method(TomlTable& reader) {
  const MethodPtr method = parse_method(reader.string("method"));
  const HbvmMethod* const hbvm = as_hbvm(*method);
  if (hbvm && hbvm->name().is_auto()) reader.fail("a study states its k");
  return method;
}

/// A number of the method's name, by its letter; "---" if it has none.
inline std::string letter(const MethodPtr& method, const std::string& letter) {
  const Constants all = method->parameters();
  const auto place = all.find(letter);
  return place == all.end() ? "---" : place->second.text();
}

}  // namespace hbvm

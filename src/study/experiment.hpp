#pragma once

#include <filesystem>
#include <functional>

#include "hbvm/table.hpp"
#include "long_work/cells.hpp"
#include "scene/scene.hpp"
#include "step/hbvm_method.hpp"
#include "step/registry.hpp"
#include "study/study.hpp"
#include "toml/toml_table.hpp"

namespace hbvm::core {

/// What the parts of a study are read with. Outlives them.
struct Experiment {
  std::filesystem::path folder;
  Scene scene;  ///< empty for a study of all scenes
  Precision precision;
  bool check;                                                        ///< compare with expected.csv
  std::vector<std::string> provenance;                               ///< of tables
  std::string command;                                               ///< that makes the results again
  std::filesystem::path results;                                     ///< the folder that files go to
  std::function<void(const Figure&, const std::string& file)> draw;  ///< if pictures can be drawn

  /// The key of a run: all that its result depends on. \param further of this kind of run
  std::string key(const std::string& kind, const Scene& of, const std::string& method, const Expression& step,
                  const Expression& until, const std::string& further) const;
};

/// What a part of a study has to run, and what it makes of the results, which stand in the same order.
template <class Outcome>
struct Part {
  std::vector<WorkCell> cells;
  std::function<Outcome(const std::vector<std::string>& results)> conclude;
};

/// The findings of a study: columns and groups of its table, and what it was held against.
struct Findings {
  Table table;
  Table full;                             ///< the same with all digits, and empty cells where there is no number
  StudyOutcome outcome;                   ///< the comparison
  std::vector<std::string> numbers = {};  ///< columns of its own that hold decimals
};

/// Files that a part of a study made, and what it could not make.
struct Drawn {
  std::vector<std::string> files, warnings;
};

/// Draws NAME.svg into the results; where it cannot be drawn, that is a warning. \throws InputError
void draw(const Experiment& experiment, const Figure& figure, Drawn& drawn);

/// The kinds of a study. Each takes its own keys of study.toml.
Part<Findings> halving_study(const Experiment& experiment, TomlTable& top);
Part<Findings> long_run_study(const Experiment& experiment, TomlTable& top);
Part<Findings> conservation_study(const Experiment& experiment, TomlTable& top);
Part<Findings> sweep_study(const Experiment& experiment, TomlTable& top);

/// A [[figure]] of study.toml: its runs, whose results are trajectories as the text of CSV files, and the picture. What
/// comes out are the files written. These are the trajectories (CSV, and what describes them) and the picture (SVG). It
/// is a warning where it cannot be drawn.
Part<Drawn> study_figure(const Experiment& experiment, TomlTable reader);

/// The method that a table of study.toml names.
inline MethodPtr stated_method(TomlTable& reader) {
  MethodPtr method = parse_method(reader.string("method"));
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

}  // namespace hbvm::core

#include "study/study.hpp"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <map>
#include <memory>

#include "checksum.hpp"
#include "expected_csv.hpp"
#include "experiment.hpp"
#include "hbvm/version.hpp"
#include "read_file.hpp"
#include "report/csvw.hpp"
#include "write_file.hpp"

namespace hbvm::core {
namespace {

namespace fs = std::filesystem;

/// A scene file beside the study, or a built-in name.
Scene find_scene(const fs::path& folder, const std::string& name) {
  const fs::path beside = folder / name;
  return load_scene(fs::exists(beside) ? beside.string() : name);
}

/// "studies/kepler", also of "studies/kepler/".
std::string name_of_study(const std::string& folder) {
  const fs::path path(folder);
  return (path.has_filename() ? path : path.parent_path()).filename().string();
}

fs::path make_results_folder(const StudyRequest& request, const std::optional<fs::path>& out) {
  std::string name = request.precision.name();
  for (char& c : name)
    if (c == ':') c = '_';
  fs::path results = (out ? *out / name_of_study(request.folder) : fs::path(request.folder) / "results") / name;
  std::error_code failure;
  fs::create_directories(results, failure);
  if (failure) throw InputError("cannot write " + results.string() + ": " + failure.message());
  return results;
}

/// Marks that stand where a printed table has no number are empty cells, which readers know as missing.
void blank_marks(std::vector<std::string>& cells) {
  for (std::string& cell : cells)
    if (cell == "---" || cell == "***") cell.clear();
}

/// A study.toml that was read: what there is to run, and what comes of it.
class Study {
 public:
  /// \throws InputError
  Study(const StudyRequest& request, const StudyOptions& options)
      : source_(read_file(fs::path(request.folder) / "study.toml"), (fs::path(request.folder) / "study.toml").string()),
        root_(source_.parse()),
        experiment_{request.folder, {}, request.precision, options.check, {}, {}, {}, options.draw} {
    TomlTable top(source_, root_, "study");
    title_ = top.string("title");
    const std::string kind = top.string("kind");
    const std::map<std::string, Part<Findings> (*)(const Experiment&, TomlTable&)> kinds{
        {"step_halving", halving_study},
        {"long_run", long_run_study},
        {"conservation", conservation_study},
        {"sweep", sweep_study}};
    if (!kinds.contains(kind))
      top.fail("unknown kind '" + kind + "': use step_halving, long_run, conservation or sweep");
    const bool all_scenes = kind == "conservation";
    Scene& scene = experiment_.scene;
    if (!all_scenes) scene = find_scene(request.folder, top.string("scene"));
    experiment_.command = "hbvm study " + name_of_study(request.folder) + " --precision " + request.precision.name();
    experiment_.provenance = {std::string("hbvm ") + version(), "command " + experiment_.command,
                              all_scenes ? "scenes: all built-in ones" : "scene " + scene.name + ": " + scene.title};
    experiment_.results = make_results_folder(request, options.out);
    table_ = kinds.at(kind)(experiment_, top);
    for (const toml::table* entry : top.tables("figure"))
      figures_.push_back(study_figure(experiment_, TomlTable(source_, *entry, "figure")));
    top.finish();
  }
  Study(const Study&) = delete;

  std::vector<WorkCell> cells() const {
    std::vector<WorkCell> all = table_.cells;
    for (const auto& figure : figures_) all.insert(all.end(), figure.cells.begin(), figure.cells.end());
    return all;
  }

  /// Writes tables and figures from the results of these cells. \throws InputError
  StudyOutcome conclude(const std::vector<std::string>& results) const {
    auto next = results.begin();
    const auto results_of = [&](const std::vector<WorkCell>& cells) {
      const auto first = next;
      next += static_cast<std::ptrdiff_t>(cells.size());
      return std::vector<std::string>(first, next);
    };
    Findings findings = table_.conclude(results_of(table_.cells));
    StudyOutcome outcome = std::move(findings.outcome);
    outcome.title = title_;
    Table& table = findings.table;
    table.caption = title_;
    table.provenance = experiment_.provenance;
    for (const auto& [name, text] : {std::pair("table.csv", to_csv(table)), std::pair("table.md", to_markdown(table)),
                                     std::pair("table.tex", to_latex(table))}) {
      write_file(experiment_.results / name, text);
      outcome.files.push_back((experiment_.results / name).string());
    }
    write_full(std::move(findings.full), findings.numbers, outcome);
    table.provenance.clear();  // comments of the file, for nobody at a terminal
    outcome.table = to_markdown(table);
    for (const auto& figure : figures_) {
      const Drawn drawn = figure.conclude(results_of(figure.cells));
      outcome.files.insert(outcome.files.end(), drawn.files.begin(), drawn.files.end());
      outcome.warnings.insert(outcome.warnings.end(), drawn.warnings.begin(), drawn.warnings.end());
    }
    return outcome;
  }

 private:
  /// What a column of a table holds, by its name. \param numbers are decimals
  CsvType type_of(const std::string& column, const std::vector<std::string>& numbers) const {
    const bool in_double = experiment_.precision.kind() == Precision::Kind::binary64;
    if (std::find(numbers.begin(), numbers.end(), column) != numbers.end() || column.starts_with("e_") ||
        column == "output_delta_H")
      return in_double ? CsvType::binary64 : CsvType::decimal;
    if (column.starts_with("rate_") || column == "iterations per step" || column == "seconds") return CsvType::binary64;
    return column == "k" || column == "s" || column == "i" ? CsvType::integer : CsvType::text;
  }

  /// The table with all digits, and what describes it.
  void write_full(Table table, const std::vector<std::string>& numbers, StudyOutcome& outcome) const {
    const std::string file = (experiment_.results / "table_full.csv").string();
    for (auto& group : table.groups) {
      blank_marks(group.keys);
      for (auto& row : group.rows) blank_marks(row);
    }
    CsvMetadata metadata{title_, experiment_.scene.name.empty() ? "" : write_scene(experiment_.scene), {}, {}};
    metadata.properties = {
        {"version", version()}, {"command", experiment_.command}, {"precision", experiment_.precision.name()}};
    for (const std::string& column : csv_columns(table))
      metadata.columns.push_back({column, type_of(column, numbers), ""});
    write_csv(file, table, metadata);
    outcome.files.push_back(file);
    outcome.files.push_back(csvw_file(file));
  }

  TomlSource source_;
  toml::table root_;
  Experiment experiment_;
  std::string title_;
  Part<Findings> table_;
  std::vector<Part<Drawn>> figures_;
};

/// \throws InputError if two folders would have their results in one
void refuse_same_names(const std::vector<StudyRequest>& requests) {
  std::map<std::string, fs::path> folders;
  for (const StudyRequest& request : requests) {
    const auto [place, is_new] = folders.try_emplace(name_of_study(request.folder), request.folder);
    if (!is_new && !fs::equivalent(place->second, request.folder))
      throw InputError("'" + place->second.string() + "' and '" + request.folder +
                       "' have the same name: run them one by one");
  }
}

std::optional<StudyOutcome> conclude(const Study& study, const CellStore& store) {
  std::vector<std::string> results;
  for (const WorkCell& cell : study.cells()) {
    const std::string* const result = store.find(cell.key);
    if (!result) return std::nullopt;
    results.push_back(*result);
  }
  return study.conclude(results);
}

}  // namespace

std::string Experiment::key(const std::string& kind, const Scene& of, const std::string& method, const Expression& step,
                            const Expression& until, const std::string& further) const {
  // The scene itself, not its name: files may change.
  std::string key = kind + "|" + fs::path(of.name).stem().string() + "|" + Checksum(write_scene(of)).text();
  for (const std::string& part : {method, step.text(), until.text(), precision.name(), further}) key += "|" + part;
  return key;
}

std::vector<std::optional<StudyOutcome>> run_studies(const std::vector<StudyRequest>& requests,
                                                     const StudyOptions& options) {
  std::vector<std::unique_ptr<Study>> studies;
  std::map<std::string, WorkCell> different;
  std::vector<WorkCell> cells;
  for (const StudyRequest& request : requests) {
    studies.push_back(std::make_unique<Study>(request, options));
    for (WorkCell& cell : studies.back()->cells())
      if (different.try_emplace(cell.key, cell).second) cells.push_back(std::move(cell));
  }
  if (options.out) refuse_same_names(requests);

  CellStore in_memory;
  CellOptions of_cells = options;
  if (!options.store) of_cells.store = &in_memory;
  std::exception_ptr failure;
  try {
    run_cells(cells, of_cells);
  } catch (...) {
    failure = std::current_exception();
  }
  std::vector<std::optional<StudyOutcome>> outcomes;
  for (const auto& study : studies) outcomes.push_back(conclude(*study, *of_cells.store));
  if (failure) std::rethrow_exception(failure);
  return outcomes;
}

}  // namespace hbvm::core

#include "hbvm/analysis/study.hpp"

#include <filesystem>
#include <fstream>
#include <map>

#include "expected_csv.hpp"
#include "experiment.hpp"
#include "hbvm/read_file.hpp"
#include "hbvm/version.hpp"
#include "study_figure.hpp"

namespace hbvm {
namespace {

namespace fs = std::filesystem;

/// A scene file beside the study, or a built-in name.
Scene find_scene(const fs::path& folder, const std::string& name) {
  const fs::path beside = folder / name;
  return load_scene(fs::exists(beside) ? beside.string() : name);
}

fs::path make_results_folder(const fs::path& folder, const Precision& precision) {
  std::string name = precision.name();
  for (char& c : name)
    if (c == ':') c = '_';
  const fs::path results = folder / "results" / name;
  std::error_code failure;
  fs::create_directories(results, failure);
  if (failure) throw InputError("cannot write " + results.string() + ": " + failure.message());
  return results;
}

void write(const fs::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw InputError("cannot write " + path.string());
}

}  // namespace

StudyOutcome run_study(const std::string& folder, const Precision& precision, bool check,
                       const std::function<void(long, long)>& progress) {
  const fs::path toml = fs::path(folder) / "study.toml";
  const TomlSource source(read_file(toml), toml.string());
  const toml::table root = source.parse();
  TomlTable top(source, root, "study");
  StudyOutcome outcome;
  outcome.title = top.string("title");
  const std::string kind = top.string("kind");
  const std::map<std::string, Findings (*)(const Experiment&, TomlTable&)> kinds{
      {"step_halving", halving_study}, {"long_run", long_run_study}, {"conservation", conservation_study}};
  if (!kinds.contains(kind)) top.fail("unknown kind '" + kind + "': use step_halving, long_run or conservation");
  const bool all_scenes = kind == "conservation";
  const Experiment experiment{folder, all_scenes ? Scene{} : find_scene(folder, top.string("scene")), precision, check,
                              progress};
  const std::vector<const toml::table*> figures = top.tables("figure");
  const fs::path results = make_results_folder(folder, precision);

  Findings findings = kinds.at(kind)(experiment, top);
  static_cast<Agreement&>(outcome) = std::move(findings.agreement);
  Table& table = findings.table;
  table.caption = outcome.title;
  table.provenance = {
      std::string("hbvm ") + version(),
      "command hbvm study " + fs::path(folder).filename().string() + " --precision " + precision.name(),
      all_scenes ? "scenes: all built-in ones" : "scene " + experiment.scene.name + ": " + experiment.scene.title};
  outcome.table = to_markdown(table);
  for (const auto& [name, text] : {std::pair("table.csv", to_csv(table)), std::pair("table.md", outcome.table),
                                   std::pair("table.tex", to_latex(table))}) {
    write(results / name, text);
    outcome.files.push_back((results / name).string());
  }
  for (const toml::table* entry : figures)
    for (std::string& file : study_figure(experiment, TomlTable(source, *entry, "figure"), table.provenance, results))
      outcome.files.push_back(std::move(file));
  top.finish();
  return outcome;
}

}  // namespace hbvm

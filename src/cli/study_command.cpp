#include <fmt/format.h>

#include <memory>
#include <optional>

#include "commands.hpp"
#include "long_work.hpp"
#include "output_files.hpp"
#include "processes/draw.hpp"
#include "study/study.hpp"

namespace hbvm::core {
namespace {

struct StudyArguments {
  std::vector<std::string> folders;
  std::vector<std::string> precisions{"double"};
  bool check = false;
  WorkArguments work{"runs.jsonl"};
};

/// "Table 2, quad: 165 of 165 printed figures agree", and the pictures.
std::string summary(const StudyOutcome& outcome, const Precision& precision, bool check) {
  std::string line = fmt::format("{}, {}: ", outcome.title, precision.name());
  if (check) {
    line += fmt::format("{} of {} {} agree", outcome.agreed, outcome.stated, outcome.what);
    if (outcome.further > 0)
      line += fmt::format("; {} of {} round-off columns and rates beyond double hold", outcome.further_agreed,
                          outcome.further);
  } else {
    line += "done";
  }
  std::string pictures;
  for (const std::string& file : outcome.files)
    if (file.ends_with(".svg")) pictures += (pictures.empty() ? "" : ", ") + file;
  return line + "\n    pictures: " + (pictures.empty() ? "none" : pictures) + "\n";
}

void study_command(const StudyArguments& o) {
  std::vector<Precision> precisions;
  for (const std::string& name : o.precisions) precisions.push_back(Precision::parse(name));
  std::vector<StudyRequest> requests;
  for (const std::string& folder : o.folders)
    for (const Precision& precision : precisions) requests.push_back({folder, precision});
  StudyOptions options;
  options.draw = draw;
  options.check = o.check;
  options.out = o.work.make_folder();
  std::vector<std::optional<StudyOutcome>> outcomes;
  {
    LongWork work(o.work, options.out, "study", options);
    outcomes = run_studies(requests, options);
  }
  long agreed = 0, stated = 0;
  bool all_met = true, all_there = true;
  std::string tables, summaries;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    if (!outcomes[i]) {
      all_there = false;
      continue;
    }
    const StudyOutcome& outcome = *outcomes[i];
    tables += outcome.table + "\n";
    for (const std::string& complaint : outcome.complaints) tables += "  not met: " + complaint + "\n";
    summaries += summary(outcome, requests[i].precision, o.check);
    if (outcome.what == "printed figures") {
      agreed += outcome.agreed;
      stated += outcome.stated;
    }
    all_met = all_met && outcome.complaints.empty();
  }
  for (const std::optional<StudyOutcome>& outcome : outcomes)
    if (outcome) {
      say_written_together(outcome->files);
      for (const std::string& warning : outcome->warnings) fmt::print(stderr, "warning: {}\n", warning);
    }
  // Printed last of all, so that standard output stays empty if a study cannot be run.
  fmt::print("{}{}{}", tables, tables.empty() ? "" : "\n", summaries);
  if (!all_there)
    fmt::print("the runs of shard {} are in {}; tables come from all shards, by --merge\n", *o.work.shard,
               (*options.out / o.work.store).string());
  if (stated > 0) fmt::print("{} of {} printed figures agree\n", agreed, stated);
  std::fflush(stdout);
  if (!all_met) throw CLI::RuntimeError(1);
}

}  // namespace

void add_study_command(CLI::App& app) {
  auto o = std::make_shared<StudyArguments>();
  CLI::App* const command =
      app.add_subcommand("study", "Run the experiments of studies/ and draw their tables and figures");
  command->add_option("folders", o->folders, "Folders with a study.toml; results go to results/ in each, or to --out")
      ->required();
  command->add_option("--precision", o->precisions, "One or more of double, quad, mpfr:N")->capture_default_str();
  command->add_flag("--check", o->check, "Compare with expected.csv; exit code 1 if a figure does not agree");
  o->work.add_to(*command, "Folder for results instead, and for runs.jsonl, from which an interrupted study goes on",
                 "Threads");
  command->footer("Example: hbvm study studies/table_2_modified_pendulum --precision double mpfr:50 --check");
  command->callback([o] { study_command(*o); });
}

}  // namespace hbvm::core

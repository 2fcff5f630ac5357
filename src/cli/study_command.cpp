#include <fmt/format.h>

#include <memory>

#include "commands.hpp"
#include "hbvm/analysis/study.hpp"
#include "hbvm/error.hpp"
#include "progress_bar.hpp"

namespace hbvm {
namespace {

struct StudyArguments {
  std::vector<std::string> folders;
  std::vector<std::string> precisions{"double"};
  bool check = false;
};

void study_command(const StudyArguments& o) {
  std::vector<Precision> precisions;
  for (const std::string& name : o.precisions) precisions.push_back(Precision::parse(name));
  long agreed = 0, stated = 0;
  bool all_met = true;
  std::string tables, summary;
  for (const std::string& folder : o.folders) {
    for (const Precision& precision : precisions) {
      StudyOutcome outcome;
      {
        ProgressBar bar(folder);
        outcome = run_study(folder, precision, o.check, [&](long done, long of) { bar.update(done, of); });
      }
      tables += outcome.table + "\n";
      for (const std::string& complaint : outcome.complaints) tables += "  not met: " + complaint + "\n";
      std::string line = fmt::format("{}, {}: ", outcome.title, precision.name());
      if (o.check) {
        line += fmt::format("{} of {} {} agree", outcome.agreed, outcome.stated, outcome.what);
        if (outcome.further > 0)
          line += fmt::format("; {} of {} round-off columns and rates beyond double hold", outcome.further_agreed,
                              outcome.further);
        if (outcome.what == "printed figures") {
          agreed += outcome.agreed;
          stated += outcome.stated;
        }
        all_met = all_met && outcome.complaints.empty();
      } else {
        line += "done";
      }
      std::string pictures;
      for (const std::string& file : outcome.files)
        if (file.ends_with(".svg")) pictures += (pictures.empty() ? "" : ", ") + file;
      summary += line + "\n    pictures: " + (pictures.empty() ? "none" : pictures) + "\n";
    }
  }
  // Printed last of all, so that standard output stays empty if a study cannot be run.
  fmt::print("{}\n{}", tables, summary);
  if (o.check && stated > 0) fmt::print("{} of {} printed figures agree\n", agreed, stated);
  std::fflush(stdout);
  if (!all_met) throw CLI::RuntimeError(1);
}

}  // namespace

void add_study_command(CLI::App& app) {
  auto o = std::make_shared<StudyArguments>();
  CLI::App* const command =
      app.add_subcommand("study", "Run the experiments of studies/ and draw their tables and figures");
  command->add_option("folders", o->folders, "Folders with a study.toml; results go to results/ in each")->required();
  command->add_option("--precision", o->precisions, "One or more of double, quad, mpfr:N")->capture_default_str();
  command->add_flag("--check", o->check, "Compare with expected.csv; exit code 1 if a figure does not agree");
  command->footer("Example: hbvm study studies/table_2_modified_pendulum --precision double mpfr:50 --check");
  command->callback([o] { study_command(*o); });
}

}  // namespace hbvm

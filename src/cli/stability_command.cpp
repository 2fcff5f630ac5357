#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "commands.hpp"
#include "hard_cases/collection.hpp"
#include "hard_cases/report.hpp"
#include "hard_cases/stability.hpp"
#include "hbvm/error.hpp"
#include "hbvm/version.hpp"
#include "long_work.hpp"
#include "processes/draw.hpp"
#include "report/csvw.hpp"
#include "write_file.hpp"

namespace hbvm::core {
namespace {

namespace fs = std::filesystem;

struct StabilityArguments {
  std::optional<std::string> cases;
  bool quick = false, full = false, json = false, figures = false;
  WorkArguments work{"results.jsonl"};

  Collection collection() const { return full ? Collection::full : Collection::quick; }
};

std::vector<HardCase> cases_of(const StabilityArguments& o) {
  std::vector<HardCase> cases = hard_cases(o.collection());
  if (!o.cases) return cases;
  std::string families;
  for (const HardCase& c : cases)
    if (families.find(c.family + "; ") == std::string::npos) families += c.family + "; ";
  std::erase_if(cases, [&](const HardCase& c) { return c.key().find(*o.cases) == std::string::npos; });
  if (cases.empty())
    throw InputError("--cases: '" + *o.cases +
                     "' occurs in no family, case, parameter or precision; the families are: " + families);
  return cases;
}

void stability_command(const StabilityArguments& o) {
  if (o.figures && !o.work.out) throw InputError("--figures needs a folder: --out FOLDER");
  const std::vector<HardCase> cases = cases_of(o);
  std::string command = std::string("hbvm stability") + (o.full ? " --full" : " --quick");
  if (o.cases) command += " --cases '" + *o.cases + "'";

  command += o.work.provenance();
  const std::optional<fs::path> folder = o.work.make_folder();
  StabilityOptions options;
  options.collection = o.collection();
  std::vector<CaseFinding> findings;
  {
    LongWork work(o.work, folder, "stability", options);
    findings = stability(cases, options);
  }
  Table table = stability_table(findings);
  table.provenance = {std::string("hbvm ") + version(), "command " + command, summary(findings)};
  if (folder) {
    write_csv((*folder / "stability.csv").string(), table);
    write_file(*folder / "stability.md", to_markdown(table));
    write_file(*folder / "stability.json", to_json(findings, command) + "\n");
    if (o.figures)
      for (const Figure& figure : stability_figures(folder->string(), folder->string()))
        draw(figure, (*folder / (figure.name + ".svg")).string());
  }
  if (o.json) {
    std::cout << to_json(findings, command) << std::endl;
  } else {
    fmt::print("{}", to_text(table));
    for (const CaseFinding& f : findings)
      if (f.verdict == CaseVerdict::not_as_expected)
        fmt::print("not as expected: {}, {}, {}: {}\n", f.name, f.parameter, f.precision, f.reason);
    fmt::print("{}\n", summary(findings));
    if (folder) fmt::print("written to {}\n", folder->string());
    std::fflush(stdout);
  }
  if (std::any_of(findings.begin(), findings.end(),
                  [](const CaseFinding& f) { return f.verdict == CaseVerdict::not_as_expected; }))
    throw CLI::RuntimeError(1);
}

}  // namespace

void add_stability_command(CLI::App& app) {
  auto o = std::make_shared<StabilityArguments>();
  CLI::App* const command =
      app.add_subcommand("stability", "Run the collection of hard cases: each holds, or fails as it should");
  auto* const quick = command->add_flag("--quick", o->quick, "Some cases of each family (default): about a minute");
  command->add_flag("--full", o->full, "All, in double, quad and 50 digits, up to 10^7 steps: hours; see --out")
      ->excludes(quick);
  command->add_option("--cases", o->cases, "Only cases whose family, name, parameter or precision holds this text");
  o->work.add_to(*command,
                 "Folder for the table (CSV, Markdown, JSON) and results.jsonl, from which an interrupted run goes on",
                 "Processes");
  command
      ->add_flag("--figures", o->figures,
                 "Also draw the study's figures there, beside what an earlier program gave (*_before.csv)")
      ->excludes("--shard");
  command->add_flag("--json", o->json, "Print one JSON object and nothing else");
  command->footer(
      "Exit code 1 if a case does not end as expected. See studies/stability.\n"
      "Example: hbvm stability --cases separatrix --out stability");
  command->callback([o] { stability_command(*o); });
}

}  // namespace hbvm::core

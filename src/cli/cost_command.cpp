#include <fmt/format.h>

#include <cmath>
#include <iostream>
#include <memory>
#include <optional>

#include "commands.hpp"
#include "cost/cost_methods.hpp"
#include "cost/cost_report.hpp"
#include "cost/measuring_system.hpp"
#include "cost/planner.hpp"
#include "door/door.hpp"
#include "hbvm/version.hpp"
#include "long_work.hpp"
#include "output_files.hpp"
#include "processes/draw.hpp"
#include "processes/in_processes.hpp"
#include "report/csvw.hpp"
#include "scene_argument.hpp"
#include "signals.hpp"
#include "write_file.hpp"

namespace hbvm::core {
namespace {

namespace fs = std::filesystem;

struct CostArguments {
  SceneArgument scene;
  std::string until = "10", quantity = "all", range = "2:100";
  std::vector<std::string> methods, precisions;
  double seconds = 2;
  std::optional<int> digits;
  bool json = false;
  WorkArguments work{"cells.jsonl"};
};

double number_in(const std::string& text, const std::string& option) {
  std::size_t end = 0;
  double value = 0;
  try {
    value = std::stod(text, &end);
  } catch (const std::exception&) {
    end = std::string::npos;
  }
  if (end != text.size() || !std::isfinite(value)) throw InputError(option + ": '" + text + "' is no number");
  return value;
}

/// "2:100".
std::pair<double, double> range_of_digits(const std::string& text) {
  const std::string option = "--digits-range";
  const std::size_t colon = text.find(':');
  if (colon == std::string::npos) throw InputError(option + " '" + text + "': use A:B, as 2:100");
  const std::pair range{number_in(text.substr(0, colon), option), number_in(text.substr(colon + 1), option)};
  if (!(range.first > 0 && range.first < range.second && range.second <= most_reference_digits - 50))
    throw InputError(
        fmt::format("{} '{}': digits go up, from more than 0 to at most {}", option, text, most_reference_digits - 50));
  return range;
}

CostStudy study_of(const CostArguments& o) {
  CostStudy study{scene_of(o.scene.load()), expression_of(o.until, "--until:")};
  study.quantity = parse_cost_quantity(o.quantity);
  std::tie(study.least_digits, study.most_digits) = range_of_digits(o.range);
  study.methods = cost_methods(o.methods, study.most_digits);
  for (const std::string& name : o.precisions) study.precisions.push_back(Precision::parse(name));
  if (!(o.seconds > 0)) throw InputError("--seconds: a run takes more than 0 s");
  study.most_seconds = o.seconds;
  return study;
}

const char* const unfinished = "the work was not finished";

std::string quoted_words(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words)
    text += " " + (word.find_first_of(" *()'") == std::string::npos ? word : "'" + word + "'");
  return text;
}

std::string command_of(const CostArguments& o) {
  std::string text = "hbvm cost" + quoted_words({o.scene.name});
  for (const std::string& setting : o.scene.settings) text += " --set" + quoted_words({setting});
  text += " --until" + quoted_words({o.until});
  if (!o.methods.empty()) text += " --methods" + quoted_words(o.methods);
  if (!o.precisions.empty()) text += " --precisions" + quoted_words(o.precisions);
  return text + " --quantity " + o.quantity;
}

void grid_command(const CostArguments& o) {
  CostStudy study = study_of(o);
  std::string command = command_of(o) + " --digits-range " + o.range;
  if (o.seconds != CostArguments().seconds) command += fmt::format(" --seconds {:g}", o.seconds);
  command += o.work.provenance();
  const std::optional<fs::path> folder = o.work.make_folder();
  study.with_steps_and_energy = folder.has_value();
  CostOutcome outcome;
  {
    CostOptions options;
    options.apart = in_processes;
    LongWork work(o.work, folder, "cost", options);
    ProgressBar bar("reference");
    options.reference_progress = bar.part_done(unfinished);
    outcome = run_cost_study(study, options);
  }
  const std::string json = to_json(study, outcome, command);
  std::vector<std::string> files;
  if (folder && outcome.complete) {
    const Table table = cost_table(study, outcome);
    CsvMetadata metadata{table.caption, {}, {{"version", version()}, {"command", command}}, cost_columns()};
    for (const auto& property : measuring_system()) metadata.properties.push_back(property);
    metadata.properties.emplace_back("reference", outcome.reference.source);
    const std::string csv = (*folder / "cost.csv").string();
    write_csv(csv, table, metadata);
    write_file(*folder / "cost.json", json + "\n");
    files = {csv, csvw_file(csv), (*folder / "cost.json").string()};
    for (const auto& [name, further] : {std::pair{"steps", step_time_table(study, outcome.step_times)},
                                        {"energy", energy_table(study, *outcome.energy_until, outcome.energies)},
                                        {"conserving", energy_table(study, study.until, outcome.conserving)}}) {
      if (further.groups.front().rows.empty()) continue;
      const std::string file = (*folder / (std::string(name) + ".csv")).string();
      CsvMetadata of_further = metadata;
      of_further.title = further.caption;
      of_further.columns = further_cost_columns(further);
      write_csv(file, further, of_further);
      files.push_back(file);
    }
    for (const Figure& figure : cost_figures(study, outcome))
      for (const char* const ending : {".svg", ".pdf"}) {
        const std::string file = (*folder / (figure.name + ending)).string();
        try {
          draw(figure, file);
          files.push_back(file);
        } catch (const InputError&) {
          throw;
        } catch (const Error& error) {
          fmt::print(stderr, "warning: {}\n", error.what());
        }
      }
  }
  say_written_together(files);
  if (o.json) {
    std::cout << json << std::endl;
    return;
  }
  fmt::print("{}", to_text(cheapest_table(study, outcome)));
  fmt::print("{} runs of {}; the motion magnifies errors by 10^{:.1f}; compared with {} digits ({})\n",
             outcome.findings.size(), outcome.cells, outcome.nature.digits_lost, outcome.reference.digits,
             outcome.reference.source);
  if (!outcome.complete)
    fmt::print("the runs of shard {} are in {}; tables come from all shards, by --merge\n", *o.work.shard,
               (*folder / o.work.store).string());
  std::fflush(stdout);
}

void plan_command(const CostArguments& o) {
  PlanRequest request{scene_of(o.scene.load()), expression_of(o.until, "--until:"), *o.digits,
                      parse_cost_quantity(o.quantity)};
  request.methods = cost_methods(o.methods, request.digits, Choice::dense);
  for (const std::string& name : o.precisions) request.precisions.push_back(Precision::parse(name));
  const std::string command = command_of(o) + fmt::format(" --digits {}", *o.digits);
  std::optional<Plan> plan;
  {
    ProgressBar bar("cost");
    request.progress = bar.part_done(unfinished);
    plan = plan_cost(request);
  }
  if (o.json)
    std::cout << to_json(request, *plan, command) << std::endl;
  else
    std::cout << to_text(request, *plan) << std::flush;
}

}  // namespace

void add_cost_command(CLI::App& app) {
  auto o = std::make_shared<CostArguments>();
  CLI::App* const command = app.add_subcommand(
      "cost", "What accuracy costs in time: error against time over methods, orders, steps and precisions");
  std::string families;
  for (const std::string& name : cost_families()) families += (families.empty() ? "" : ", ") + name;
  o->scene.add_to(*command);
  command->add_option("--methods", o->methods,
                      "Methods, or families of them: " + families + " (default: all of these families)");
  command->add_option("--precisions", o->precisions, "Some of double, quad, mpfr:N (default: what the digits ask for)");
  command->add_option("--digits-range", o->range, "A:B, the right digits that runs are to have")->capture_default_str();
  command->add_option("--until", o->until, "Time at which the state is compared")->capture_default_str();
  command->add_option("--quantity", o->quantity, "What has to be right: q, p, lambda or all")->capture_default_str();
  command->add_option("--seconds", o->seconds, "Leave out runs that are predicted to take longer")
      ->capture_default_str();
  o->work.jobs = 1;
  o->work.add_to(*command,
                 "Folder for the table (CSV, JSON), figures (SVG, PDF) and cells.jsonl, from which an interrupted "
                 "study goes on",
                 "Processes; more than one disturb one another's times");
  auto* const digits =
      command->add_option("--digits", o->digits, "Find the cheapest setting for so many right digits instead");
  for (const char* const other : {"--digits-range", "--seconds", "--out", "--shard", "--merge", "--jobs"})
    digits->excludes(other);
  command->add_flag("--json", o->json, "Print one JSON object and nothing else");
  command->footer(
      "Example: hbvm cost double_pendulum --digits-range 2:30 --out cost\n"
      "         hbvm cost double_pendulum --digits 25");
  command->callback([o] {
    end_runs_on_signals();
    if (o->digits)
      plan_command(*o);
    else
      grid_command(*o);
  });
}

}  // namespace hbvm::core

#include "compare_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>

#include "comparison_page.hpp"
#include "door/door.hpp"
#include "hbvm/error.hpp"
#include "output_files.hpp"
#include "picture_file.hpp"
#include "progress_bar.hpp"
#include "read_file.hpp"
#include "report/csvw.hpp"
#include "scene/set_number.hpp"
#include "signals.hpp"

namespace hbvm::core {
namespace {

/// With the steps that were given, or else those that are stored in or beside them.
std::vector<ResultsFile> read_results(const ComparisonArguments& arguments) {
  if (!arguments.steps.empty() && arguments.steps.size() != arguments.files.size())
    throw InputError(fmt::format("--steps: there are {} for {} files", arguments.steps.size(), arguments.files.size()));
  std::vector<ResultsFile> files;
  for (const std::string& name : arguments.files) {
    ResultsFile file{name, read_file(name)};
    const std::string description = csvw_file(name);
    std::error_code ignored;
    if (!arguments.steps.empty()) file.step = arguments.steps[files.size()];
    if (std::filesystem::is_regular_file(description, ignored)) file.description = read_file(description);
    files.push_back(std::move(file));
  }
  return files;
}

/// What makes the comparison again.
std::string command_of(const hbvm::Scene& scene, const ComparisonArguments& arguments) {
  std::string command = "hbvm reference " + scene.name() + settings_in_command(scene_of(scene));
  const auto add = [&](const char* option, const std::vector<std::string>& values) {
    for (const std::string& value : values) command += fmt::format(" {} '{}'", option, value);
  };
  add("--against", arguments.files);
  add("--map", arguments.map);
  add("--steps", arguments.steps);
  return command + (arguments.cost ? " --cost" : "");
}

/// \throws CLI::RuntimeError if it is not what was asked for
void judge(const Comparison& against, const ComparisonArguments& arguments) {
  // An order that is measured at two steps is off by what follows the leading error.
  constexpr double room = double{1} / 4;
  std::string failed;
  if (arguments.order && !(against.order() >= *arguments.order - room))
    failed +=
        fmt::format("the order is {}, and not {}\n",
                    std::isfinite(against.order()) ? fmt::format("{:.2f}", against.order()) : "none", *arguments.order);
  if (arguments.digits && !(against.least_digits() >= *arguments.digits))
    failed += fmt::format("{:.1f} digits are right, and not {}\n", against.least_digits(), *arguments.digits);
  if (failed.empty()) return;
  std::fflush(stdout);
  fmt::print(stderr, "{}", failed);
  throw CLI::RuntimeError(1);
}

}  // namespace

std::vector<std::pair<std::string, std::string>> read_map(const std::vector<std::string>& parts) {
  std::vector<std::string> texts;
  for (const std::string& part : parts)
    if (!texts.empty() && std::ranges::count(texts.back(), '(') > std::ranges::count(texts.back(), ')'))
      texts.back() += "," + part;
    else
      texts.push_back(part);
  std::vector<std::pair<std::string, std::string>> map;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
      throw InputError("--map: '" + text + "' is not of the form theirs=ours");
    map.emplace_back(text.substr(0, equals), text.substr(equals + 1));
  }
  return map;
}

void ComparisonArguments::refuse_alone() const {
  if (!map.empty() || !plots.empty() || !steps.empty() || order || digits || cost)
    throw InputError("reference: --map, --plot, --steps, --expect-order, --require and --cost go with --against");
}

void add_comparison_options(CLI::App& command, ComparisonArguments& arguments) {
  command
      .add_option("--against", arguments.files,
                  "Files of results of any program, CSV: how many of their digits are right")
      ->delimiter(',');
  command
      .add_option("--map", arguments.map,
                  "What their columns are, \"theirs=ours,...\": theirs an expression in their names, ours t or a name "
                  "of q, p, velocity or what the scene observes, as in sin(theta)=bob.x")
      ->delimiter(',');
  command
      .add_option("--steps", arguments.steps,
                  "With --against: the steps that the files were made with, for the order of convergence; else what "
                  "they store, or the time between their lines")
      ->delimiter(',');
  command.add_option("--expect-order", arguments.order,
                     "With --against: exit code 1 unless the two smallest steps show this order, or a quarter less");
  command.add_option("--require", arguments.digits,
                     "With --against: exit code 1 unless so many digits of all components are right at all times");
  command.add_flag("--cost", arguments.cost,
                   "With --against: also plan the cheapest run with as many digits, which may take minutes");
  command
      .add_option(
          "--plot", arguments.plots,
          "With --against: digits against time, .svg, .pdf or .png; as .html a page with the verdict and tables")
      ->allow_extra_args(false);
}

void compare_results(const hbvm::Scene& scene, bool json, const ComparisonArguments& arguments) {
  const std::vector<PictureFile> pictures(arguments.plots.begin(), arguments.plots.end());
  ResultsRequest request{.scene = scene, .files = read_results(arguments)};
  request.map = read_map(arguments.map);
  request.cost = arguments.cost;
  ProgressBar bar("reference");
  end_runs_on_signals();
  request.progress = bar.part_done("the comparison was not finished");
  const Comparison against = hbvm::compare_results(request);
  for (const PictureFile& picture : pictures)
    picture.write([&] { return figure_of(against, scene.name()); },
                  [&] { return comparison_page(against, scene.name(), command_of(scene, arguments)); });
  std::cout << (json ? to_json(against) + "\n" : to_text(against)) << std::flush;
  judge(against, arguments);
}

}  // namespace hbvm::core

#include "compare_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>

#include "compare/comparison.hpp"
#include "hbvm/error.hpp"
#include "output_files.hpp"
#include "processes/draw.hpp"
#include "progress_bar.hpp"
#include "read_file.hpp"
#include "report/csvw.hpp"
#include "signals.hpp"

namespace hbvm::core {
namespace {

/// "theirs=ours": theirs may hold no "=". A comma within parentheses, as in atan2(y, x), divides nothing.
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

/// With the steps that were given, or else those that are stored in or beside them.
std::vector<ResultsFile> read_results(const ComparisonArguments& arguments) {
  if (!arguments.steps.empty() && arguments.steps.size() != arguments.files.size())
    throw InputError(fmt::format("--steps: there are {} for {} files", arguments.steps.size(), arguments.files.size()));
  std::vector<ResultsFile> files;
  for (const std::string& name : arguments.files) {
    ResultsFile file{name, read_file(name)};
    const std::string description = csvw_file(name);
    std::error_code ignored;
    file.step = !arguments.steps.empty() ? arguments.steps[files.size()]
                                         : step_stored(file.csv, std::filesystem::is_regular_file(description, ignored)
                                                                     ? read_file(description)
                                                                     : std::string());
    file.step_given = !arguments.steps.empty();
    files.push_back(std::move(file));
  }
  return files;
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

void ComparisonArguments::refuse_alone() const {
  if (!map.empty() || plot || !steps.empty() || order || digits)
    throw InputError("reference: --map, --plot, --steps, --expect-order and --require go with --against");
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
  command.add_option("--plot", arguments.plot, "With --against: digits against time, SVG, PDF or PNG");
}

void compare_results(const Scene& scene, bool json, const ComparisonArguments& arguments) {
  ComparisonRequest request;
  request.scene = scene;
  request.files = read_results(arguments);
  request.map = read_map(arguments.map);
  ProgressBar bar("reference");
  end_runs_on_signals();
  request.progress = bar.part_done("the comparison was not finished");
  const Comparison against = compare_with_reference(request);
  if (arguments.plot) {
    draw(comparison_figure(request, against, "against"), *arguments.plot);
    say_written(*arguments.plot);
  }
  std::cout << (json ? to_json(against) + "\n" : to_text(against)) << std::flush;
  judge(against, arguments);
}

}  // namespace hbvm::core

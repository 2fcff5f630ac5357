#include "compare_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

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

/// A time with the digits it needs: what a program added up in double as the number that was meant.
std::string shown_time(const std::string& text) {
  const double t = std::strtod(text.c_str(), nullptr);
  double shown = t;
  constexpr int most = 15;
  for (int digits = 1; digits <= most; ++digits) {
    shown = std::strtod(fmt::format("{:.{}g}", t, digits).c_str(), nullptr);
    if (std::abs(shown - t) <= std::abs(t) * std::pow(10, -most)) break;
  }
  return fmt::format("{}", shown);
}

/// 10^exponent with two digits, whatever its size.
std::string power_text(double exponent) {
  double whole = std::floor(exponent);
  std::string digits = fmt::format("{:.1f}", std::pow(10, exponent - whole));
  if (digits == "10.0") {
    digits = "1.0";
    ++whole;
  }
  return fmt::format("{}e{:.0f}", digits, whole);
}

std::string digits_text(double digits) { return std::isnan(digits) ? "-" : fmt::format("{:.1f}", digits); }

nlohmann::ordered_json json_of(const Comparison& against) {
  nlohmann::ordered_json j{{"digits", against.digits}, {"files", nlohmann::ordered_json::array()}};
  for (const FileComparison& file : against.files) {
    nlohmann::ordered_json entry{{"name", file.name}, {"t", file.times}, {"unused", file.unused}};
    entry["start"] = file.has_start ? nlohmann::ordered_json::array() : nlohmann::ordered_json(nullptr);
    for (const StartDifference& d : file.start)
      entry["start"].push_back({{"name", d.name}, {"theirs", d.theirs}, {"scene", d.ours}});
    for (const ComponentDigits& c : file.components) entry["right_digits"][c.name] = c.digits;
    entry["log10_H_drift"] = file.H_drift;
    entry["log10_g_drift"] = file.g_drift;
    entry["step"] = file.step;
    entry["reference"] = file.stored ? "stored" : "computed now";
    j["files"].push_back(entry);
  }
  j["by_growth"] = against.by_growth;
  j["orders"] = nlohmann::ordered_json::array();
  j["order_between"] = nlohmann::ordered_json::array();
  for (const Convergence& c : against.orders) {
    j["orders"].push_back(c.order);
    j["order_between"].push_back({against.files[c.coarse].name, against.files[c.fine].name});
  }
  return j;
}

void print_start(const FileComparison& file) {
  if (!file.has_start) {
    fmt::print("  no row at t = 0: that it starts as the scene does is not seen\n");
    return;
  }
  if (file.start.empty()) return;
  fmt::print("  ITS START IS ANOTHER, and so is all that follows:\n");
  for (const StartDifference& d : file.start)
    fmt::print("    {} is {}, and {} in the scene{}\n", d.name, d.theirs, d.ours,
               d.opposite ? ": of the other sign" : fmt::format(": {} digits are right", digits_text(d.digits)));
}

/// The component with the fewest digits, or none if there are none to count.
const ComponentDigits* least_right(const FileComparison& file, std::size_t n) {
  const ComponentDigits* least = nullptr;
  for (const ComponentDigits& c : file.components)
    if (!std::isnan(c.digits[n]) && (!least || c.digits[n] < least->digits[n])) least = &c;
  return least;
}

/// Where most is lost from one time to the next. The component that is right least is looked at, since the error of
/// another may pass through 0.
void print_loss(const FileComparison& file) {
  std::size_t where = 0;
  const ComponentDigits* what = nullptr;
  double most = 1;
  for (std::size_t n = 1; n < file.times.size(); ++n) {
    const ComponentDigits *const before = least_right(file, n - 1), *const after = least_right(file, n);
    if (before == nullptr || after == nullptr || !(before->digits[n - 1] - after->digits[n] > most)) continue;
    most = before->digits[n - 1] - after->digits[n];
    where = n;
    what = after;
  }
  if (what)
    fmt::print("  most is lost between t = {} and {}: {:.1f} digits of {}\n", shown_time(file.times[where - 1]),
               shown_time(file.times[where]), most, what->name);
}

void print(const FileComparison& file, const std::vector<double>& by_growth) {
  fmt::print("{}\n", file.name);
  print_start(file);
  for (const std::string& reason : file.unused) fmt::print("  not used: {}\n", reason);
  std::size_t width = 14;
  for (const ComponentDigits& c : file.components) width = std::max(width, c.name.size());
  fmt::print("  {:<16} {:>7}  {:<{}}{:>16}{:>9}{:>9}\n", "t", "digits", "least right", width,
             by_growth.empty() ? "" : "growth leaves", "H off", "g off");
  constexpr std::size_t most_lines = 20;
  const std::size_t lines = std::min(most_lines, file.times.size());
  const auto power = [](const std::vector<double>& drift, std::size_t n) {
    return n < drift.size() ? std::isinf(drift[n]) ? std::string("0") : power_text(drift[n]) : std::string("-");
  };
  for (std::size_t i = 1; i <= lines; ++i) {
    const std::size_t n = file.times.size() * i / lines - 1;
    const ComponentDigits* const least = least_right(file, n);
    fmt::print("  {:<16} {:>7}  {:<{}}{:>16}{:>9}{:>9}\n", shown_time(file.times[n]),
               least ? digits_text(least->digits[n]) : "-", least ? least->name : "", width,
               n < by_growth.size() ? fmt::format("{:.1f}", by_growth[n]) : "", power(file.H_drift, n),
               power(file.g_drift, n));
  }
  fmt::print("  at the end:");
  for (const ComponentDigits& c : file.components) fmt::print(" {} {}", c.name, digits_text(c.digits.back()));
  fmt::print("\n");
  for (const ComponentDigits& c : file.components)
    if (std::any_of(c.digits.begin(), c.digits.end(), [](double d) { return std::isnan(d); }))
      fmt::print("  {} is exactly 0, which has no digits: off by {:.3g}\n", c.name, c.off_zero);
  print_loss(file);
}

std::string step_text(const FileComparison& file) {
  return file.step_text.empty() ? fmt::format("{:.3g}, by its times,", file.step) : file.step_text;
}

void print(const Comparison& against) {
  const bool stored = std::all_of(against.files.begin(), against.files.end(), [](const auto& f) { return f.stored; });
  fmt::print("right digits beside a reference of {} digits, {}; H and g are off relative to the size of their terms\n",
             against.digits, stored ? "stored" : "computed now");
  for (std::size_t f = 0; f < against.files.size(); ++f)
    print(against.files[f], f == 0 ? against.by_growth : std::vector<double>());
  for (const Convergence& c : against.orders) {
    const FileComparison &a = against.files[c.coarse], &b = against.files[c.fine];
    fmt::print("order of convergence from {} to {}: {}\n", a.name, b.name,
               std::isfinite(c.order)
                   ? fmt::format("{:.2f}", c.order)
                   : fmt::format("none, with steps of {} and {} to t = {} and {}{}", step_text(a), step_text(b),
                                 shown_time(a.times.back()), shown_time(b.times.back()),
                                 a.step == b.step ? "; the steps that they were made with are said by --steps" : ""));
  }
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
                  "of q, p or velocity, as in sin(theta)=bob.x")
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
  if (json)
    std::cout << json_of(against).dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << std::endl;
  else
    print(against);
  judge(against, arguments);
}

}  // namespace hbvm::core

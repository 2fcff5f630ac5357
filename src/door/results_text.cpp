#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "hbvm/results.hpp"

namespace hbvm {
namespace {

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

std::string start_of(const FileComparison& file) {
  if (!file.has_start) return "  no row at t = 0: that it starts as the scene does is not seen\n";
  std::string text = file.start.empty() ? "" : "  ITS START IS ANOTHER, and so is all that follows:\n";
  for (const StartDifference& d : file.start)
    text +=
        fmt::format("    {} is {}, and {} in the scene{}\n", d.name, d.theirs, d.ours,
                    d.opposite ? ": of the other sign" : fmt::format(": {} digits are right", digits_text(d.digits)));
  return text;
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
std::string loss_of(const FileComparison& file) {
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
  if (!what) return {};
  return fmt::format("  most is lost between t = {} and {}: {:.1f} digits of {}\n", shown_time(file.times[where - 1]),
                     shown_time(file.times[where]), most, what->name);
}

std::string text_of(const FileComparison& file, const std::vector<double>& by_growth) {
  std::string text = file.name + "\n" + start_of(file);
  for (const std::string& reason : file.unused) text += fmt::format("  not used: {}\n", reason);
  std::size_t width = 14;
  for (const ComponentDigits& c : file.components) width = std::max(width, c.name.size());
  text += fmt::format("  {:<16} {:>7}  {:<{}}{:>16}{:>9}{:>9}\n", "t", "digits", "least right", width,
                      by_growth.empty() ? "" : "growth leaves", "H off", "g off");
  constexpr std::size_t most_lines = 20;
  const std::size_t lines = std::min(most_lines, file.times.size());
  const auto power = [](const std::vector<double>& drift, std::size_t n) {
    return n < drift.size() ? std::isinf(drift[n]) ? std::string("0") : power_text(drift[n]) : std::string("-");
  };
  for (std::size_t i = 1; i <= lines; ++i) {
    const std::size_t n = file.times.size() * i / lines - 1;
    const ComponentDigits* const least = least_right(file, n);
    text += fmt::format("  {:<16} {:>7}  {:<{}}{:>16}{:>9}{:>9}\n", shown_time(file.times[n]),
                        least ? digits_text(least->digits[n]) : "-", least ? least->name : "", width,
                        n < by_growth.size() ? fmt::format("{:.1f}", by_growth[n]) : "", power(file.H_drift, n),
                        power(file.g_drift, n));
  }
  text += "  at the end:";
  for (const ComponentDigits& c : file.components) text += fmt::format(" {} {}", c.name, digits_text(c.digits.back()));
  text += "\n";
  for (const ComponentDigits& c : file.components)
    if (std::any_of(c.digits.begin(), c.digits.end(), [](double d) { return std::isnan(d); }))
      text += fmt::format("  {} is exactly 0, which has no digits: off by {:.3g}\n", c.name, c.off_zero);
  return text + loss_of(file);
}

std::string step_text(const FileComparison& file) {
  return file.step_text.empty() ? fmt::format("{:.3g}, by its times,", file.step) : file.step_text;
}

}  // namespace

std::string to_text(const Comparison& against) {
  const bool stored = std::all_of(against.files.begin(), against.files.end(), [](const auto& f) { return f.stored; });
  std::string text = fmt::format(
      "right digits beside a reference of {} digits, {}; H and g are off relative to the size of their terms\n",
      against.digits, stored ? "stored" : "computed now");
  for (std::size_t f = 0; f < against.files.size(); ++f)
    text += text_of(against.files[f], f == 0 ? against.by_growth : std::vector<double>());
  for (const OrderBetween& c : against.orders) {
    const FileComparison &a = against.files[c.coarse], &b = against.files[c.fine];
    text += fmt::format(
        "order of convergence from {} to {}: {}\n", a.name, b.name,
        std::isfinite(c.order)
            ? fmt::format("{:.2f}", c.order)
            : fmt::format("none, with steps of {} and {} to t = {} and {}{}", step_text(a), step_text(b),
                          shown_time(a.times.back()), shown_time(b.times.back()),
                          a.step == b.step ? "; the steps that they were made with are said by --steps" : ""));
  }
  return text;
}

}  // namespace hbvm

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "compare/lost_digits.hpp"
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

std::string start_of(const FileComparison& file) {
  if (!file.has_start) return "  no row at t = 0: that it starts as the scene does is not seen\n";
  std::string text = file.start.empty() ? "" : "  ITS START IS ANOTHER, and so is all that follows:\n";
  for (const StartDifference& d : file.start)
    text += fmt::format(
        "    {} is {}, and {} in the scene{}\n", d.name, d.theirs, d.ours,
        d.opposite ? ": of the other sign" : fmt::format(": {} digits are right", core::digits_text(d.digits)));
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

std::string text_of(const FileComparison& file) {
  std::string text = file.name + "\n" + start_of(file);
  for (const std::string& reason : file.unused) text += fmt::format("  not used: {}\n", reason);
  std::size_t width = 14;
  for (const ComponentDigits& c : file.components) width = std::max(width, c.name.size());
  const std::array<core::ErrorPart, 4> parts = core::parts_of_error(file);
  text += fmt::format("  {:<16} {:>7}  {:<{}}  ", "t", "digits", "least right", width);
  for (const core::ErrorPart& part : parts)
    if (!part.digits.empty()) text += fmt::format("{:>9}", part.title);
  text += "\n";
  constexpr std::size_t most_lines = 20;
  const std::size_t lines = std::min(most_lines, file.times.size());
  for (std::size_t i = 1; i <= lines; ++i) {
    const std::size_t n = file.times.size() * i / lines - 1;
    const ComponentDigits* const least = least_right(file, n);
    text += fmt::format("  {:<16} {:>7}  {:<{}}  ", shown_time(file.times[n]),
                        least ? core::digits_text(least->digits[n]) : "-", least ? least->name : "", width);
    for (const core::ErrorPart& part : parts)
      if (!part.digits.empty()) text += fmt::format("{:>9}", core::digits_text(part.digits[n]));
    text += "\n";
  }
  text += "  at the end:";
  for (const ComponentDigits& c : file.components)
    text += fmt::format(" {} {}", c.name, core::digits_text(c.digits.back()));
  text += "\n";
  for (const ComponentDigits& c : file.components)
    if (std::any_of(c.digits.begin(), c.digits.end(), [](double d) { return std::isnan(d); }))
      text += fmt::format("  {} is exactly 0, which has no digits: off by {:.3g}\n", c.name, c.off_zero);
  text += loss_of(file);
  return file.mostly ? text + fmt::format("  the error at the end is mostly {}\n", name_of(*file.mostly)) : text;
}

std::string step_text(const FileComparison& file) {
  return file.step_text.empty() ? fmt::format("{:.3g}, by its times,", file.step) : file.step_text;
}

}  // namespace

std::string name_of(LostBy part) {
  switch (part) {
    case LostBy::growth:
      return "the first error, magnified by the motion itself";
    case LostBy::g:
      return "leaving the constraints g";
    case LostBy::hidden:
      return "leaving the hidden constraint";
    case LostBy::energy:
      return "a change of H";
    case LostBy::motion:
      break;
  }
  return "along the motion, which keeps H and the constraints better, as where it runs late";
}

std::string to_text(const Comparison& against) {
  const bool stored = std::all_of(against.files.begin(), against.files.end(), [](const auto& f) { return f.stored; });
  std::string text = fmt::format(
      "right digits beside a reference of {} digits, {}, and what one part of the error alone would leave: the growth\n"
      "of the first error by the motion itself, leaving g, leaving the hidden constraint, and what H is off by\n",
      against.digits, stored ? "stored" : "computed now");
  for (const FileComparison& file : against.files) text += text_of(file);
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
  if (against.measured_order)
    text += fmt::format("order of convergence of all: {:.2f} +- {:.1g}\n", against.measured_order->value,
                        against.measured_order->uncertainty);
  if (against.plan) text += "the same digits of the positions, as cheaply as the planner finds\n" + against.plan->text;
  return text;
}

}  // namespace hbvm

#include "comparison_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "compare/lost_digits.hpp"
#include "csv_line.hpp"
#include "folder_report/folder_report.hpp"
#include "hbvm/error.hpp"
#include "hbvm/version.hpp"
#include "processes/draw.hpp"
#include "temporary_folder.hpp"
#include "write_file.hpp"

namespace hbvm::core {
namespace {

namespace fs = std::filesystem;

/// A name within a table of Markdown.
std::string cell(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '|' ? std::string("\\|") : std::string(1, c);
  return safe;
}

/// The order between a file and that of the next greater step.
std::string order_of(const Comparison& against, std::size_t file) {
  for (const OrderBetween& c : against.orders)
    if (c.fine == file && std::isfinite(c.order)) return fmt::format("{:.2f}", c.order);
  return "-";
}

std::string verdict_of(const Comparison& against, const std::string& scene) {
  std::string text = fmt::format(
      "# Right digits beside the reference of {}\n\nThe reference has {} digits. Beside the digits that are right at "
      "the last time stand those that one part of the error alone would leave: the growth of the first error by the "
      "motion itself, leaving g, leaving the hidden constraint, and what H is off by. The order of convergence is that "
      "from the next greater step.\n\n"
      "| file | t | right digits | growth | g | hidden | H | order | the error is mostly |\n"
      "|---|---|---|---|---|---|---|---|---|\n",
      scene, against.digits);
  for (std::size_t f = 0; f < against.files.size(); ++f) {
    const FileComparison& file = against.files[f];
    text += fmt::format("| {} | {} | {} |", cell(file.name), file.times.back(), digits_text(-file.error));
    for (const ErrorPart& part : parts_of_error(file))
      text += fmt::format(" {} |", part.digits.empty() ? "-" : digits_text(part.digits.back()));
    text += fmt::format(" {} | {} |\n", order_of(against, f), file.mostly ? name_of(*file.mostly) : "-");
  }
  text += "\n";
  if (against.measured_order)
    text += fmt::format("The order of convergence of all is {:.2f} +- {:.1g}.\n\n", against.measured_order->value,
                        against.measured_order->uncertainty);
  for (const FileComparison& file : against.files)
    for (const StartDifference& d : file.start)
      text += fmt::format("- {} starts elsewhere: {} is {}, and {} in the scene.\n", cell(file.name), d.name, d.theirs,
                          d.ours);
  text += "\n![Right digits against time](digits.svg)\n";
  if (against.plan)
    text +=
        "\n## What these digits cost\n\nThe same digits of the positions, as cheaply as the planner finds:\n\n```\n" +
        against.plan->text + "\n```\n";
  text += "\n## What was not used\n\n";
  for (const FileComparison& file : against.files)
    text += fmt::format("- {}: {}\n", cell(file.name),
                        file.unused.empty() ? "all was" : fmt::format("{}", fmt::join(file.unused, "; ")));
  return text;
}

/// Right digits of each component at each time, as CSV.
std::string table_of(const FileComparison& file) {
  std::vector<std::string> names;
  for (const ComponentDigits& c : file.components) names.push_back(c.name);
  std::string text = "t," + csv_line(names) + "\n";
  for (std::size_t n = 0; n < file.times.size(); ++n) {
    text += file.times[n];
    for (const ComponentDigits& c : file.components) text += "," + digits_text(c.digits[n]);
    text += "\n";
  }
  return text;
}

}  // namespace

std::string comparison_page(const Comparison& against, const std::string& scene, const std::string& command) {
  const TemporaryFolder folder;
  write_file(folder.file("verdict.md"), verdict_of(against, scene));
  draw(figure_of(against, scene), folder.file("digits.svg"));
  for (std::size_t f = 0; f < against.files.size(); ++f)
    write_file(folder.file(fmt::format("digits {} {}.csv", f + 1, fs::path(against.files[f].name).stem().string())),
               table_of(against.files[f]));
  return folder_report(folder.path(), version(), command);
}

}  // namespace hbvm::core

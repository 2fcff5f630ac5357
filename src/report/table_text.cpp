#include <algorithm>

#include "csv_line.hpp"
#include "hbvm/table.hpp"

namespace hbvm {
namespace {

std::string joined(const std::vector<std::string>& cells, const std::string& separator) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) line += (i > 0 ? separator : "") + cells[i];
  return line;
}

std::vector<std::string> each(std::vector<std::string> cells, std::string (*shown)(const std::string&)) {
  for (std::string& cell : cells) cell = shown(cell);
  return cells;
}

std::vector<std::string> both(std::vector<std::string> cells, const std::vector<std::string>& further) {
  cells.insert(cells.end(), further.begin(), further.end());
  return cells;
}

/// A bar would end the cell.
std::string markdown_cell(const std::string& cell) {
  std::string text;
  for (const char c : cell) text += c == '|' ? std::string("\\|") : std::string(1, c);
  return text;
}

/// Text as LaTeX shows it.
std::string latex_text(const std::string& text) {
  if (text.starts_with(">= ")) return "$\\ge$ " + latex_text(text.substr(3));
  std::string result;
  for (const char c : text) {
    if (c == '_' || c == '&' || c == '%' || c == '#')
      result += std::string("\\") + c;
    else if (c == '<' || c == '>')
      result += std::string("$") + c + "$";
    else
      result += c;
  }
  return result;
}

/// Names like e_H, rate_lambda and output_delta_H as formulas.
std::string latex_name(const std::string& name) {
  if (name.starts_with("rate")) return "rate";
  if (name == "+-") return "$\\pm$";
  const auto underscore = name.find('_');
  if (underscore == std::string::npos) return name.size() == 1 ? "$" + name + "$" : latex_text(name);
  const std::string base = name.substr(0, underscore), rest = name.substr(underscore + 1);
  if (base == "delta" && rest.size() == 1) return "$\\delta " + rest + "$";
  if (base.size() > 1) return latex_text(base) + " " + latex_name(rest);
  std::string index = rest;
  if (index == "lambda")
    index = "\\lambda";
  else if (index.size() > 1)
    index = "\\mathrm{" + latex_text(index) + "}";
  return "$" + base + "_{" + index + "}$";
}

}  // namespace

std::string to_text(const Table& table) {
  std::vector<std::size_t> widths;
  for (const std::string& column : table.columns) widths.push_back(column.size());
  for (const auto& group : table.groups)
    for (const auto& row : group.rows)
      for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  std::string text;
  const auto line = [&](const std::vector<std::string>& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i)
      text += "  " + cells[i] + std::string(widths[i] - cells[i].size(), ' ');
    text.erase(text.find_last_not_of(' ') + 1);
    text += '\n';
  };
  for (const auto& group : table.groups) {
    text += group.heading + "\n";
    line(table.columns);
    for (const auto& row : group.rows) line(row);
    text += '\n';
  }
  return text;
}

std::vector<std::string> csv_columns(const Table& table) { return both(table.key_columns, table.columns); }

std::string to_csv(const Table& table) {
  std::string text = core::csv_line(csv_columns(table)) + "\n";
  for (const auto& group : table.groups)
    for (const auto& row : group.rows) text += core::csv_line(both(group.keys, row)) + "\n";
  return text;
}

std::string to_markdown(const Table& table) {
  std::string text = "**" + table.caption + "**\n";
  for (const auto& group : table.groups) {
    if (!group.heading.empty()) text += "\n" + group.heading + "\n";
    text += "\n| " + joined(table.columns, " | ") + " |\n|";
    for (std::size_t i = 0; i < table.columns.size(); ++i) text += "---:|";
    text += "\n";
    for (const auto& row : group.rows) text += "| " + joined(each(row, markdown_cell), " | ") + " |\n";
  }
  text += "\n";
  for (const std::string& line : table.provenance) text += "<!-- " + line + " -->\n";
  return text;
}

std::string to_latex(const Table& table) {
  std::vector<std::string> names;
  for (const std::string& column : table.columns) names.push_back(latex_name(column));
  const std::string span = std::to_string(names.size());
  std::string text;
  for (const std::string& line : table.provenance) text += "% " + line + "\n";
  // What does not fit on a page is set by the package longtable.
  constexpr std::size_t rows_of_a_page = 50;
  std::size_t rows = 0;
  for (const auto& group : table.groups) rows += group.rows.size();
  const bool fits = rows <= rows_of_a_page;
  const std::string columns = "{|" + std::string(names.size(), 'c') + "|}\n",
                    caption = "\\caption{" + latex_text(table.caption) + "}";
  text += fits ? "\\begin{table}[t]\n" + caption + "\n\\smallskip\\small\n\\centerline{\n\\begin{tabular}" + columns
               : "\\begin{longtable}" + columns + caption + "\\\\\n";
  text += "\\hline\n";
  for (const auto& group : table.groups) {
    const bool formula = group.heading.find('=') != std::string::npos;
    const std::string heading = formula ? "$" + group.heading + "$" : latex_text(group.heading);
    if (!heading.empty()) text += "\\multicolumn{" + span + "}{|c|}{" + heading + "}\\\\\n\\hline\n";
    text += joined(names, " & ") + "\\\\\n\\hline\n";
    for (const auto& row : group.rows) text += joined(each(row, latex_text), " & ") + "\\\\\n";
    text += "\\hline\n\\hline\n";
  }
  return text + (fits ? "\\end{tabular}}\n\\end{table}\n" : "\\end{longtable}\n");
}

}  // namespace hbvm

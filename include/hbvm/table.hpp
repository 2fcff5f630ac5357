#pragma once

#include <string>
#include <vector>

namespace hbvm {

/// A table of text: numbers come already formatted, so that no scalar type is needed here. Rows stand in groups, as
/// the paper's tables do (one for each method).
struct Table {
  struct Group {
    std::string heading;            ///< "s = 1"
    std::vector<std::string> keys;  ///< what the group stands for, under key_columns
    std::vector<std::vector<std::string>> rows;
  };
  std::string caption;
  std::vector<std::string> provenance;   ///< what made it: version, command, scene, precision
  std::vector<std::string> key_columns;  ///< columns that only the CSV repeats in each row: "k", "s"
  std::vector<std::string> columns;
  std::vector<Group> groups;
};

/// Columns aligned, for a terminal.
std::string to_text(const Table& table);
/// Comma-separated values below a line of the column names. A cell that holds no number but a mark is left as it is.
/// Caption and provenance are for what describes the file, see write_csv().
std::string to_csv(const Table& table);
/// Its column names.
std::vector<std::string> csv_columns(const Table& table);
/// Markdown, a table for each group.
std::string to_markdown(const Table& table);
/// A LaTeX table in the paper's layout: a heading and the names above each group.
std::string to_latex(const Table& table);

}  // namespace hbvm

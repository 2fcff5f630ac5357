#pragma once

#include <string>
#include <vector>

namespace hbvm::core {

/// What a CSV file says: the names of its columns, and its rows, each with as many cells.
struct CsvTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

/// Reads RFC 4180, cells of several lines included. \param file its name, for messages
/// \throws InputError with file and line: for a row with another number of cells, a quote that does not end, or no text
CsvTable read_csv_table(const std::string& text, const std::string& file);

}  // namespace hbvm::core

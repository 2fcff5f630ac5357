#pragma once

#include <string>
#include <vector>

namespace hbvm::core {

/// A cell of comma-separated values: in quotes, and its quotes twice, if it holds what separates cells or lines
/// (RFC 4180).
std::string csv_cell(const std::string& text);

/// The cells with commas between them, without the end of the line.
std::string csv_line(const std::vector<std::string>& cells);

/// The cells of a line, out of their quotes.
std::vector<std::string> split_csv_line(const std::string& line);

}  // namespace hbvm::core

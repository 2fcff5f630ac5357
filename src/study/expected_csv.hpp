#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hbvm::core {

/// The number in a cell.
/// \throws InputError
double value_of(const std::string& cell);

/// A study's expected.csv: column names in the first line, after "# " or not, and remarks in lines that begin with #.
struct ExpectedCsv {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;

  /// \throws InputError
  explicit ExpectedCsv(const std::filesystem::path& path);

  /// The cell of a row, empty if the column does not exist.
  std::string cell(const std::vector<std::string>& row, const std::string& column) const;
};

}  // namespace hbvm::core

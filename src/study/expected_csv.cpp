#include "expected_csv.hpp"

#include <sstream>

#include "csv_line.hpp"
#include "hbvm/error.hpp"
#include "read_file.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {

double value_of(const std::string& cell) { return literal<double>(cell); }

ExpectedCsv::ExpectedCsv(const std::filesystem::path& path) {
  std::istringstream text(read_file(path));
  for (std::string line; std::getline(text, line);) {
    if (columns.empty() && !line.empty()) {
      columns = split_csv_line(line.starts_with("# ") ? line.substr(2) : line);
      if (line[0] >= '0' && line[0] <= '9')
        throw InputError(path.string() + ": the first line must have the names of the columns, not '" + line + "'");
    } else if (!line.empty() && !line.starts_with('#')) {
      rows.push_back(split_csv_line(line));
    }
    if (!rows.empty() && rows.back().size() != columns.size())
      throw InputError(path.string() + ": '" + line + "' has " + std::to_string(rows.back().size()) +
                       " cells instead of " + std::to_string(columns.size()));
  }
}

std::string ExpectedCsv::cell(const std::vector<std::string>& row, const std::string& column) const {
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (columns[i] == column) return row[i];
  return {};
}

}  // namespace hbvm::core

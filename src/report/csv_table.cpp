#include "csv_table.hpp"

#include <fmt/format.h>

#include "csv_line.hpp"
#include "hbvm/error.hpp"

namespace hbvm::core {

CsvTable read_csv_table(const std::string& text, const std::string& file) {
  CsvTable table;
  std::size_t line = 1;
  const auto fail = [&](const std::string& what) { throw InputError(fmt::format("{}:{}: {}", file, line, what)); };
  for (std::size_t at = text.starts_with("\xef\xbb\xbf") ? 3 : 0; at < text.size();) {
    // A record ends with its line, unless that is within quotes.
    std::size_t end = at, lines = 0;
    bool quoted = false;
    for (; end < text.size() && (quoted || text[end] != '\n'); ++end) {
      if (text[end] == '"') quoted = !quoted;
      if (text[end] == '\n') ++lines;
      if (text[end] == '\0') fail("a byte 0, which no CSV has");
    }
    if (quoted) fail("a quote that does not end");
    std::string record = text.substr(at, end - at);
    if (record.ends_with('\r')) record.pop_back();
    at = end + 1;
    if (!record.empty()) {
      std::vector<std::string> cells = split_csv_line(record);
      if (table.columns.empty())
        table.columns = std::move(cells);
      else if (cells.size() != table.columns.size())
        fail(fmt::format("{} cells, and the first line names {} columns", cells.size(), table.columns.size()));
      else
        table.rows.push_back(std::move(cells));
    }
    line += lines + 1;
  }
  line = 1;
  if (table.columns.empty()) fail("no line with the names of columns");
  return table;
}

}  // namespace hbvm::core

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "cli/json.hpp"
#include "read_file.hpp"
#include "verification/sources.hpp"

namespace hbvm::core {
namespace {

std::string page(const std::string& name) { return read_file(project / name); }

std::string trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(' ');
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(' ') + 1 - begin);
}

using Row = std::vector<std::string>;

/// A table of a page: its rows, each cell by the name of its column and its place.
struct MarkdownTable {
  Row header;
  std::vector<Row> rows;

  std::size_t column(const std::string& name, std::size_t nth = 0) const {
    for (std::size_t i = 0; i < header.size(); ++i)
      if (header[i] == name && nth-- == 0) return i;
    ADD_FAILURE() << "there is no column " << name;
    return 0;
  }
  /// The only row of a kind. \throws if there is none, or another
  const Row& row(const std::function<bool(const Row&)>& is) const {
    if (std::count_if(rows.begin(), rows.end(), is) != 1) throw std::runtime_error("no such row, or several");
    return *std::find_if(rows.begin(), rows.end(), is);
  }
};

Row cells(const std::string& line) {
  Row result;
  for (std::size_t at = 1; at < line.size();) {
    const std::size_t end = std::min(line.find('|', at), line.size());
    result.push_back(trimmed(line.substr(at, end - at)));
    at = end + 1;
  }
  return result;
}

/// The first table of the text whose header begins so.
MarkdownTable table_of(const std::string& text, const std::string& header) {
  MarkdownTable table;
  for (const std::string& line : lines_of(text)) {
    if (table.header.empty()) {
      if (line.starts_with(header)) table.header = cells(line);
    } else if (line.starts_with("|--") || line.starts_with("|:-")) {
      continue;
    } else if (line.starts_with("|")) {
      table.rows.push_back(cells(line));
    } else {
      break;
    }
  }
  EXPECT_FALSE(table.rows.empty()) << header;
  return table;
}

/// A quoted number is the computed one to its own digits; below `round_off`, of its size.
void expect_quoted(const std::string& quoted, const std::string& computed, double round_off, const std::string& where) {
  const double q = std::stod(quoted), c = std::stod(computed);
  if (std::abs(q) < round_off) {
    EXPECT_LT(std::abs(c), round_off) << where;
    EXPECT_LT(std::abs(std::log10(q / c)), 1) << where << ": " << quoted << ", computed " << computed;
    return;
  }
  const std::string mantissa = quoted.substr(0, quoted.find('e'));
  const auto point = mantissa.find('.');
  const auto decimals = point == std::string::npos ? 0 : static_cast<int>(mantissa.size() - point - 1);
  const double exponent = quoted.find('e') == std::string::npos ? 0 : std::stod(quoted.substr(quoted.find('e') + 1));
  EXPECT_LE(std::abs(q - c), 0.501 * std::pow(10, exponent - decimals))
      << where << ": " << quoted << ", computed " << computed;
}

TEST(ReadmeFigures, OfTheSatellitesAreThoseOfTheRuns) {
  const MarkdownTable quoted = table_of(page("studies/tethered_satellites/README.md"), "| k | s | until |");
  ASSERT_EQ(quoted.rows.size(), 5u);
  for (const Row& row : quoted.rows) {
    const std::string method = "hbvm:" + row[0] + "," + row[1], where = method + " until " + row[2];
    const auto run = json_of(run_of("tethered_satellites", method, "0.1", row[2]));
    const double e_H = std::stod(row[quoted.column("e_H")]);
    if (row[2] == "1000" &&
        e_H > 1e-11) {  // after t = 450 the motion is another one with every last bit, as the page says
      EXPECT_NEAR(std::stod(std::string(run["e_H"])) / e_H, 1, 0.2) << where;
    } else {
      expect_quoted(row[quoted.column("e_H")], run["e_H"], 1e-11, where + ", e_H");
    }
    expect_quoted(row[quoted.column("e_g")], run["e_g"], 1e-11, where + ", e_g");
    EXPECT_NEAR(std::stod(row[quoted.column("iterations per step")]), double(run["iterations_per_step"]), 0.2) << where;
  }
}

/// What a study prints, and its table.
struct Study {
  Study(const std::string& name, const std::string& precision) {
    const Folder folder;
    out = ended_with(0,
                     {"study", (project / "studies" / name).string(), "--check", "--precision", precision, "--out",
                      folder / "out"},
                     120)
              .out;
    std::string directory = precision;
    std::replace(directory.begin(), directory.end(), ':', '_');
    table = text_of(folder / ("out/" + name + "/" + directory + "/table.md"));
  }
  std::string out, table;
};

TEST(ReadmeFigures, CountWhatTheChecksCount) {
  for (const auto& [name, figures] : {std::pair("table_1_simple_pendulum", "78 of 78"),
                                      {"table_2_modified_pendulum", "69 of 69"},
                                      {"table_3_conical_pendulum", "18 of 18"}}) {
    expect_words(page(std::string("studies/") + name + "/README.md"), {figures});
    expect_words(Study(name, "double").out, {std::string(figures) + " printed figures agree"});
  }
  expect_words(page("README.md"), {"165 of 165"});
}

TEST(ReadmeFigures, OfTheNodesAreThoseOfTable2) {
  const MarkdownTable quoted =
      table_of(page("studies/table_2_modified_pendulum/README.md"), "| k | double | 50 digits");
  ASSERT_EQ(quoted.rows.size(), 4u);
  for (const auto& [precision, column, round_off] :
       {std::tuple("double", std::size_t{1}, 1e-15), {"mpfr:50", std::size_t{2}, 1e-45}}) {
    const std::string table = Study("table_2_modified_pendulum", precision).table;
    for (const Row& row : quoted.rows) {
      const std::size_t block = table.find("k = " + row[0]);
      ASSERT_NE(block, std::string::npos) << table;
      const MarkdownTable computed = table_of(table.substr(block), "| i ");
      const Row& of_i = computed.row([](const Row& r) { return r[0] == "7"; });
      const std::string where = std::string(precision) + ", k = " + row[0];
      expect_quoted(row[column], of_i[computed.column("e_H")], round_off, where);
      if (column == 2) {
        EXPECT_EQ(row[3], of_i[computed.column("rate_H")]) << where;
      }
    }
  }
}

TEST(ReadmeFigures, OfWhatIsConservedAreThoseOfTheStudy) {
  const MarkdownTable quoted = table_of(page("studies/conservation/README.md"), "| scene | k = s: e_H");
  const MarkdownTable computed = table_of(Study("conservation", "mpfr:50").table, "| scene ");
  for (const Row& row : quoted.rows)
    for (const bool more : {false, true}) {
      const std::string where = row[0] + (more ? ", k = " + row[3] : ", k = s");
      const Row& result = computed.row(
          [&](const Row& r) { return r[0] == row[0] && (r[computed.column("nodes")] == "k > s") == more; });
      if (more) {
        EXPECT_EQ(row[3], result[computed.column("k")]) << where;
      }
      expect_quoted(row[more ? 4 : 1], result[computed.column("e_H")], 1e-47, where + ", e_H");
      expect_quoted(row[more ? 5 : 2], result[computed.column("e_L")], 1e-47, where + ", e_L");
    }
}

/// k - s = 16 takes too long for a test.
TEST(ReadmeFigures, OfMoreNodesAreThoseOfTheRuns) {
  const MarkdownTable quoted = table_of(page("studies/orders_beyond_round_off/README.md"), "| k - s | 0 | 1 |");
  for (const Row& row : quoted.rows) {
    if (!row[0].starts_with("iterations, s = ")) continue;
    const int s = std::stoi(row[0].substr(16));
    for (std::size_t column = 1; column < 4; ++column) {
      const int k = s + std::stoi(quoted.header[column]);
      const std::string method = "hbvm:" + std::to_string(k) + "," + std::to_string(s);
      const auto run = json_of(run_of("tethered_satellites", method, "1/16", "8") +
                               Arguments{"--precision", "mpfr:50", "--solver", "paper"});
      EXPECT_NEAR(std::stod(row[column]), double(run["iterations_per_step"]), 0.06) << row[0] << ", k = " << k;
    }
  }
}

/// Of a table in CSV.
long rows_with(const std::vector<std::string>& rows, const std::string& text) {
  return std::count_if(rows.begin(), rows.end(),
                       [&](const std::string& row) { return row.find(text) != std::string::npos; });
}

/// Hours of work made these tables, which stand beside the pages.
TEST(ReadmeFigures, CountWhatTheLongTablesHold) {
  const auto claims = lines_of(page("studies/orders_beyond_round_off/tables/audit.csv"));
  const std::string audit = page("studies/orders_beyond_round_off/README.md");
  expect_words(audit, {"All " + std::to_string(rows_with(claims, ",holds")) + " claims hold"});
  EXPECT_EQ(rows_with(claims, ",fails") + rows_with(claims, ",undecidable"), 0);

  const auto cases = lines_of(page("studies/stability/tables/stability.csv"));
  long holds = 0, fails = 0, warns = 0;
  for (const std::string& row : cases) {
    holds += row.ends_with(",holds");
    fails += row.find(",\"typed failure") != std::string::npos;
    warns += row.find(",\"warned") != std::string::npos;
  }
  const std::string counted = std::to_string(holds + fails + warns) + " cases: " + std::to_string(holds) + " hold, " +
                              std::to_string(fails) + " fail with the\nerror they should, " + std::to_string(warns) +
                              " warn";
  expect_words(page("studies/stability/README.md"), {counted});
}

}  // namespace
}  // namespace hbvm::core

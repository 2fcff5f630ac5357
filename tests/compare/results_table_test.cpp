#include "compare/results_table.hpp"

#include <gtest/gtest.h>

#include "words.hpp"

namespace hbvm::core {
namespace {

using Map = std::vector<std::pair<std::string, std::string>>;

/// A table with its columns, which refer to it.
struct Read {
  ComparisonRequest request;
  ResultsTable rows;
  ResultsColumns columns;

  Read(const std::string& csv, const Map& map = {})
      : request{load_scene("simple_pendulum"), {{"theirs.csv", csv}}, map},
        rows(request.files[0]),
        columns(request, request.files[0], rows) {}

  double at(const std::string& ours, std::size_t row) const {
    return approximately(columns.value(*columns.find(ours), row));
  }
};

std::string refusal(const std::string& csv, const Map& map) {
  return message_of([&] {
    const Read read(csv, map);
    for (const ResultsColumns::Reading& reading : read.columns.readings()) read.columns.value(reading, 0);
  });
}

/// With a byte order mark, ends of lines of two characters, quotes, blanks, comments and empty lines.
TEST(ResultsTable, ReadsWhatProgramsWrite) {
  const PrecisionScope scope(30);
  const Read read("\xef\xbb\xbf\"t\" , bob.x\r\n# comment\r\n\r\n  \r\n1 ,\"-2.5e-1\"\r\n2.50,+3\r\n");
  EXPECT_EQ(read.rows.names, (std::vector<std::string>{"t", "bob.x"}));
  EXPECT_EQ(read.rows.lines, (std::vector<std::size_t>{5, 6}));
  EXPECT_EQ(read.at("bob.x", 0), -0.25);
  EXPECT_EQ(read.at("t", 1), 2.5);
  EXPECT_EQ(read.columns.text(*read.columns.find("t"), 1), "2.50");
  EXPECT_EQ(read.columns.find("bob.y"), nullptr);
}

TEST(ResultsTable, KnowsCoordinatesByNumber) {
  const PrecisionScope scope(30);
  const Read read("time,q_2,p1,v_2\n1,2,3,4\n");
  EXPECT_EQ(read.at("bob.y", 0), 2);
  EXPECT_EQ(read.at("bob.px", 0), 3);
  EXPECT_EQ(read.at("bob.vy", 0), 4);
}

/// As hbvm run writes it: p and the tangential p of the output state.
TEST(ResultsTable, TakesTheMomentaOfTheOutputState) {
  const PrecisionScope scope(30);
  const Read read("t,bob.x,bob.px,bob.py,output.bob.px\n1,2,3,4,5\n");
  EXPECT_EQ(read.at("bob.px", 0), 5);
  EXPECT_EQ(read.at("bob.py", 0), 4);
}

TEST(ResultsTable, EvaluatesTheMap) {
  const PrecisionScope scope(30);
  const Read read("n,x 1,theta.1,bob.x\n3,0,0,7\n", {{"n/2", "t"}, {"cos(theta.1) + n", "bob.x"}});
  EXPECT_EQ(read.at("t", 0), 1.5);
  EXPECT_EQ(read.at("bob.x", 0), 4);
  EXPECT_EQ(read.columns.text(*read.columns.find("t"), 0), "1.5");
}

TEST(ResultsTable, RefusesWithLineAndColumn) {
  const PrecisionScope scope(30);
  const Map none;
  struct Case {
    std::string csv;
    Map map;
    std::string says;
  };
  for (const Case& c : {Case{"t,bob.x,t\n1,2,1\n", none, "theirs.csv:1: two columns are called 't'"},
                        {"t,bob.x,q_1\n1,2,1\n", none, "two columns are bob.x, one of them 'q_1'"},
                        {"t;bob.x\n1;2\n", none, "theirs.csv:1: the names are not separated by commas: 't;bob.x'"},
                        {"t bob.x\n1 2\n", none, "theirs.csv:1: the names are not separated by commas"},
                        {"t,bob.x\n1,2,3\n", none, "theirs.csv:2: 3 cells, but 2 names"},
                        {"t,bob.x\n1,1d-3\n", none, "theirs.csv:2: column 'bob.x' holds '1d-3', which is no number"},
                        {"t,bob.x\n1,1/0\n", none, "theirs.csv:2: bob.x: "},
                        {"t,a\n1,0\n", {{"log(a)", "bob.x"}}, "theirs.csv:2: bob.x: 'log(c1)'"},
                        {"t,a\n1,2\n", {{"sin(a", "bob.x"}}, "--map: 'sin(a'"},
                        {"t,a\n1,2\n", {{"sin(b)", "bob.x"}}, "--map: 'b' is no column of theirs.csv"},
                        {"t,a\n1,2\n", {{"sin(c7)", "bob.x"}}, "--map: 'c7' is no column of theirs.csv"},
                        {"t,a\n1,2\n", {{"a", "bob.q"}}, "--map: 'bob.q' is nothing of this scene"},
                        {"t,a\n1,2\n", {{"a", "bob.x"}, {"2*a", "bob.x"}}, "--map: 'bob.x' stands twice"}})
    expect_words(refusal(c.csv, c.map), {c.says});
}

}  // namespace
}  // namespace hbvm::core

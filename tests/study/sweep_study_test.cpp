#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "csv_line.hpp"
#include "folder.hpp"
#include "read_file.hpp"
#include "study/expected_csv.hpp"
#include "study/study.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

/// A pendulum that starts at its lowest point with the speed v0. There its rod pulls most: m (g + v0^2/L).
constexpr const char* pendulum = R"(dimension = 2
[constants]
v0 = 1
x0 = 0
[[point]]
name = "pivot"
position = [0, 0]
[[body]]
name = "bob"
mass = 1
position = ["x0", -1]
velocity = ["v0", 0]
[[constraint]]
kind = "rod"
between = ["pivot", "bob"]
length = 1
[[effect]]
kind = "uniform_gravity"
acceleration = [0, "-9.81"]
)";

class SweepStudyTest : public ::testing::Test {
 protected:
  /// Rows of table_full.csv, its column names first.
  using Rows = std::vector<std::vector<std::string>>;

  StudyOutcome run(const std::string& further, const std::string& precision = "double") {
    folder_.write("pendulum.toml", pendulum);
    folder_.write("study.toml",
                  "title = \"Sweep\"\nkind = \"sweep\"\nscene = \"pendulum.toml\"\nmethod = \"hbvm:auto,3\"\n"
                  "step = \"1/16\"\nuntil = 1\n" +
                      further);
    StudyOptions options;
    options.check = check_;
    options.draw = [&](const Figure& figure, const std::string&) { figure_ = figure; };
    options.jobs = 2;
    return run_studies({{folder_.path().string(), Precision::parse(precision)}}, options).front().value();
  }
  static Rows rows_of(const StudyOutcome& outcome) {
    Rows rows;
    for (const std::string& file : outcome.files)
      if (file.ends_with("table_full.csv")) {
        std::istringstream text(read_file(file));
        for (std::string line; std::getline(text, line);) rows.push_back(split_csv_line(line));
      }
    return rows;
  }

  Folder folder_;
  Figure figure_;
  bool check_ = false;
};

constexpr const char* tension = "[[observe]]\nname = \"T\"\nvalue = \"tension(pivot, bob)\"\n";

TEST_F(SweepStudyTest, HasARowForEachPointOfTheGrid) {
  const StudyOutcome outcome = run(std::string(tension) +
                                   "[[sweep]]\nset = \"bob.mass\"\nvalues = [1, \"5/2\"]\n"
                                   "[[sweep]]\nset = \"v0\"\nfrom = 1\nto = 2\ncount = 5\n");
  EXPECT_TRUE(outcome.warnings.empty());
  const Rows rows = rows_of(outcome);
  EXPECT_EQ(rows.at(0),
            (std::vector<std::string>{"bob.mass", "v0", "e_H", "e_g", "e_hid", "T", "T_least", "T_greatest"}));
  ASSERT_EQ(rows.size(), 11u);
  for (std::size_t n = 1; n < rows.size(); ++n) {
    const double mass = value_of(rows[n][0]), v0 = value_of(rows[n][1]);
    EXPECT_EQ(mass, n <= 5 ? 1 : 2.5);
    EXPECT_EQ(v0, 1 + static_cast<double>((n - 1) % 5) / 4);
    EXPECT_NEAR(value_of(rows[n][7]), mass * (9.81 + v0 * v0), 1e-12);
    EXPECT_LT(value_of(rows[n][6]), value_of(rows[n][7]));
    EXPECT_LT(value_of(rows[n][2]), 1e-12);
  }
  // A panel for each of the value at the end, the least and the greatest; a curve for each mass.
  ASSERT_EQ(figure_.panels.size(), 3u);
  ASSERT_EQ(figure_.panels[2].curves.size(), 2u);
  EXPECT_EQ(figure_.panels[2].curves[1].label, "bob.mass = 2.5");
  ASSERT_EQ(figure_.panels[2].curves[1].points.size(), 5u);
  EXPECT_NEAR(figure_.panels[2].curves[1].points[4][1], 2.5 * 13.81, 1e-12);
}

TEST_F(SweepStudyTest, KeepsTheDigitsOfItsPrecision) {
  const Rows rows = rows_of(run(std::string(tension) + "[[sweep]]\nset = \"v0\"\nvalues = [1]\n", "mpfr:40"));
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_TRUE(rows[1][6].starts_with("10.8")) << rows[1][6];
  EXPECT_LT(value_of(rows[1][1]), 1e-37);
}

TEST_F(SweepStudyTest, DrawsErrorsWhereNothingIsObserved) {
  run("[[sweep]]\nset = \"v0\"\nvalues = [1, 2, 3]\n");
  ASSERT_EQ(figure_.panels.size(), 1u);
  EXPECT_EQ(figure_.panels[0].y.label, plain("e_H"));
  EXPECT_LT(figure_.panels[0].curves.at(0).points.at(1)[1], -12);
}

/// A start off the rod is refused there, and the other rows are made.
TEST_F(SweepStudyTest, GoesOnWhereARunFails) {
  const StudyOutcome outcome = run("[[sweep]]\nset = \"x0\"\nvalues = [0, \"1/2\"]\n");
  ASSERT_EQ(outcome.warnings.size(), 1u);
  expect_words(outcome.warnings[0], {"x0 = 0.5: ", "not consistent"});
  EXPECT_EQ(rows_of(outcome).at(2), (std::vector<std::string>{"0.5", "", "", ""}));
  expect_words(message_of<Error>([&] { run("[[sweep]]\nset = \"x0\"\nvalues = [\"1/2\", 1]\n"); }),
               {"every run of the sweep failed; x0 = 0.5: "});
}

TEST_F(SweepStudyTest, IsHeldAgainstStatedBounds) {
  check_ = true;
  folder_.write("expected.csv", "# v0,T_greatest_min,T_greatest_max,e_H_max\n1,10.8,10.9,1e-12\n2,13.9,,1e-12\n");
  const StudyOutcome outcome = run(std::string(tension) + "[[sweep]]\nset = \"v0\"\nvalues = [1, 2]\n");
  EXPECT_EQ(outcome.stated, 5);
  EXPECT_EQ(outcome.complaints, std::vector<std::string>{"T_greatest is 13.8100, below 13.9"});
}

TEST_F(SweepStudyTest, SaysWhatIsWrong) {
  const auto message = [&](const std::string& further) { return message_of<InputError>([&] { run(further); }); };
  expect_words(message(""), {"study.toml", "[[sweep]]"});
  expect_words(message("[[sweep]]\nset = \"v1\"\nvalues = [1]\n"), {"v1", "v0"});
  expect_words(message("[[sweep]]\nset = \"v0\"\nvalues = []\n"), {"study.toml:9", "sweep of 'v0'", "values"});
  expect_words(message("[[sweep]]\nset = \"v0\"\nfrom = 1\nto = 2\ncount = 1\n"), {"'count' is not between 2 and"});
  expect_words(message("[[sweep]]\nset = \"v0\"\nfrom = 1\nto = 2\nstep = 1\n"), {"count"});
  expect_words(message("[[observe]]\nname = \"T\"\nvalue = \"tension(\"\n[[sweep]]\nset = \"v0\"\nvalues = [1]\n"),
               {"column"});
}

}  // namespace
}  // namespace hbvm::core

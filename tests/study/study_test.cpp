#include "study/study.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "csv_line.hpp"
#include "folder.hpp"
#include "processes/draw.hpp"
#include "read_file.hpp"
#include "scalar/text.hpp"
#include "scene/scene.hpp"
#include "words.hpp"
#include "write_file.hpp"

namespace hbvm::core {
namespace {

namespace fs = std::filesystem;

/// A copy of a study's folder, so that results do not land in the source tree.
class StudyTest : public ::testing::Test {
 protected:
  /// Anew, if there is one.
  fs::path copy_of(const std::string& study) const {
    const fs::path target = root_ / study;
    fs::remove_all(target);
    fs::copy(fs::path(HBVM_SOURCE_DIR) / "studies" / study, target, fs::copy_options::recursive);
    return target;
  }

  static StudyOutcome run(const fs::path& folder, const std::string& precision) {
    StudyOptions options;
    options.check = true;
    options.draw = draw;
    options.jobs = 2;
    return run_studies({{folder.string(), Precision::parse(precision)}}, options).front().value();
  }

  /// With the first occurrence of `from` in one of its files replaced.
  StudyOutcome run_changed(const std::string& study, const char* file, const std::string& from, const std::string& to,
                           const std::string& precision = "double") const {
    const fs::path folder = copy_of(study);
    std::string text = read_file(folder / file);
    text.replace(text.find(from), from.size(), to);  // which throws if it is not there
    write_file(folder / file, text);
    return run(folder, precision);
  }

  Folder folder_;
  const fs::path& root_ = folder_.path();
  static constexpr const char* tables_[] = {"table_1_simple_pendulum", "table_2_modified_pendulum",
                                            "table_3_conical_pendulum"};
};

TEST_F(StudyTest, AllPrintedFiguresAgreeInDouble) {
  long agreed = 0;
  for (const char* study : tables_) {
    const StudyOutcome outcome = run(copy_of(study), "double");
    EXPECT_TRUE(outcome.complaints.empty()) << outcome.complaints.front();
    EXPECT_EQ(outcome.agreed, outcome.stated);
    agreed += outcome.agreed;
  }
  EXPECT_EQ(agreed, 165);
}

TEST_F(StudyTest, BeyondDoubleTheRatesThatWereRoundOffAppear) {
  for (const char* precision : {"quad", "mpfr:50"}) {
    long further = 0;
    for (const char* study : tables_) {
      const StudyOutcome outcome = run(copy_of(study), precision);
      EXPECT_TRUE(outcome.complaints.empty()) << precision << ": " << outcome.complaints.front();
      EXPECT_EQ(outcome.further_agreed, outcome.further);
      further += outcome.further;
    }
    EXPECT_EQ(further, 52 + 27 + 81) << precision;
  }
}

TEST_F(StudyTest, SatellitesKeepTheirBounds) {
  const StudyOutcome outcome = run(copy_of("tethered_satellites"), "double");
  EXPECT_EQ(outcome.stated, 13);
  EXPECT_TRUE(outcome.complaints.empty()) << outcome.complaints.front();
}

TEST_F(StudyTest, ScenesConserveWhatIsStated) {
  for (const char* precision : {"double", "quad"}) {
    const StudyOutcome outcome = run(copy_of("conservation"), precision);
    EXPECT_EQ(outcome.stated, 2 * static_cast<long>(built_in_scenes().size())) << precision;
    EXPECT_EQ(outcome.agreed, outcome.stated) << precision << ": " << outcome.complaints.front();
  }
}

TEST_F(StudyTest, AChangedVerdictIsReported) {
  const StudyOutcome outcome = run_changed("conservation", "expected.csv", "kepler,k = s,L,H", "kepler,k = s,H L,");
  ASSERT_EQ(outcome.complaints.size(), 1u);
  EXPECT_EQ(outcome.complaints[0], "kepler, k = s: kept 'L', lost 'H' instead of 'H L' and ''");
}

/// In whichever character: a figure agrees if all of its text does.
TEST_F(StudyTest, AChangedFigureIsReported) {
  for (const char* changed :
       {"2.20e-01", "1.30e-01", "1.21e-01", "1.20e+01", "1.20e-11", "1.20e-02", "1.20e-1", "1.2e-01"}) {
    const StudyOutcome outcome = run_changed("table_3_conical_pendulum", "expected.csv", "1.20e-01", changed);
    EXPECT_EQ(outcome.agreed, 17);
    EXPECT_EQ(outcome.stated, 18);
    ASSERT_EQ(outcome.complaints.size(), 1u) << changed;
    expect_words(outcome.complaints[0], {std::string("e_y is 1.20e-01, printed ") + changed});
  }
}

/// One unit in the last printed digit, and that in a figure further down the table.
TEST_F(StudyTest, AnotherFigureOfATableIsReported) {
  EXPECT_EQ(run_changed("table_2_modified_pendulum", "expected.csv", "9.10e-05", "9.11e-05").complaints,
            std::vector<std::string>{"k = 1, s = 1, i = 3: e_H is 9.10e-05, printed 9.11e-05"});
}

TEST_F(StudyTest, AFigureThatWasNotComputedIsReported) {
  const StudyOutcome outcome = run_changed("table_3_conical_pendulum", "study.toml", "last = 4", "last = 3");
  EXPECT_EQ(outcome.stated, 18);
  ASSERT_EQ(outcome.complaints.size(), 1u) << outcome.agreed;
  EXPECT_EQ(outcome.complaints[0].find("k = 1, s = 1, i = 4: e_y is nothing, printed "), 0u) << outcome.complaints[0];
}

/// A bound of a long run is met or reported, from above and from below.
TEST_F(StudyTest, AnExceededBoundIsReported) {
  folder_.write("long_run/study.toml",
                "title = \"Run\"\nkind = \"long_run\"\nscene = \"tethered_satellites\"\nstep = \"0.1\"\n"
                "run = [{ method = \"hbvm:1,1\", until = 10 }]\n");
  const auto complaints = [&](const std::string& bounds) {
    folder_.write("long_run/expected.csv", "k,s,until,e_H_min,e_H_max,e_g_max,only\n1,1,10," + bounds + "\n");
    const StudyOutcome outcome = run(root_ / "long_run", "double");
    EXPECT_EQ(outcome.stated - outcome.agreed, static_cast<long>(outcome.complaints.size())) << bounds;
    return outcome.complaints;
  };
  EXPECT_TRUE(complaints("1e-6,1e-2,1e-12,").empty());
  EXPECT_EQ(complaints("1e-2,,,").size(), 1u);
  EXPECT_EQ(complaints(",1e-6,,").size(), 1u);
  EXPECT_EQ(complaints(",,0,").size(), 1u);
  EXPECT_EQ(complaints("1e-2,1e-6,0,").size(), 3u);
  EXPECT_TRUE(complaints("1e-2,1e-6,0,quad").empty()) << "of another precision";
}

/// HBVM(5,1) loses a little energy, which falls by 2^10 from row to row until round-off hides it: a few thousand units
/// are still reported.
TEST_F(StudyTest, AnErrorALittleAboveRoundOffIsReported) {
  folder_.write("near_round_off/study.toml",
                "title = \"Energy\"\nkind = \"step_halving\"\nscene = \"modified_pendulum\"\nstep = \"2^(-i)\"\n"
                "until = 5\ngroup = \"k\"\ncolumns = [\"e_g\", \"e_H\"]\ncompare_above = \"1e-12\"\n"
                "round_off = [\"e_g\", \"e_H\"]\nblock = [{ method = \"hbvm:5,1\", first = 3, last = 6 }]\n");
  folder_.write("near_round_off/expected.csv", "k,s,i,e_y\n5,1,3,\n5,1,4,\n5,1,5,\n5,1,6,\n");
  const StudyOutcome outcome = run(root_ / "near_round_off", "mpfr:30");
  EXPECT_EQ(outcome.further, 8);
  EXPECT_EQ(outcome.further_agreed, 5);
  ASSERT_EQ(outcome.complaints.size(), 3u);
  for (std::size_t n = 0; n < 3; ++n)
    EXPECT_EQ(outcome.complaints[n].find("k = 5, s = 1, i = " + std::to_string(3 + n) + ": e_H is "), 0u)
        << outcome.complaints[n];
  EXPECT_EQ(outcome.complaints[2], "k = 5, s = 1, i = 5: e_H is 6.95e-27, not round-off");
}

TEST_F(StudyTest, AChangedRateBeyondDoubleIsReported) {
  EXPECT_EQ(run_changed("table_2_modified_pendulum", "study.toml", "\"2*k\"", "\"2*k+1/4\"", "quad").complaints.size(),
            7u);
}

TEST_F(StudyTest, WritesTablesAndPicturesWithProvenance) {
  const StudyOutcome outcome = run(copy_of("table_3_conical_pendulum"), "double");
  EXPECT_TRUE(outcome.warnings.empty());
  std::vector<std::string> names;
  for (const std::string& file : outcome.files) {
    const std::string name = names.emplace_back(fs::path(file).filename().string());
    const std::string text = read_file(file);
    EXPECT_GT(text.size(), 500u) << name;
    const bool told = text.find("hbvm study table_3_conical_pendulum --precision double") != std::string::npos;
    const bool bare = name.ends_with(".csv");  // described beside
    EXPECT_EQ(told, !bare) << name;
    EXPECT_EQ(bare && text.find('#') != std::string::npos, false) << name;
  }
  EXPECT_EQ(names, (std::vector<std::string>{"table.csv", "table.md", "table.tex", "table_full.csv",
                                             "table_full.csv-metadata.json", "figure_3_1.csv",
                                             "figure_3_1.csv-metadata.json", "figure_3.svg"}));
}

/// Of each kind of study: the full table rounds to the printed one, cell by cell.
TEST_F(StudyTest, WritesAllDigitsBesideThePrintedOnes) {
  for (const char* const study : {"table_1_simple_pendulum", "tethered_satellites", "conservation"}) {
    const fs::path results = copy_of(study) / "results/double";
    run(results.parent_path().parent_path(), "double");
    const auto rows_of = [&](const char* name) {
      std::vector<std::vector<std::string>> rows;
      std::istringstream lines(read_file(results / name));
      for (std::string line; std::getline(lines, line);) rows.push_back(split_csv_line(line));
      return rows;
    };
    const auto printed = rows_of("table.csv"), full = rows_of("table_full.csv");
    ASSERT_EQ(full.size(), printed.size()) << study;
    EXPECT_EQ(full[0], printed[0]);
    std::size_t longest = 0, compared = 0;
    for (std::size_t n = 1; n < full.size(); ++n) {
      ASSERT_EQ(full[n].size(), full[0].size()) << study << " " << n;
      for (std::size_t i = 0; i < full[n].size(); ++i) {
        const bool mark = printed[n][i] == "---" || printed[n][i] == "***";
        EXPECT_EQ(full[n][i].empty(), mark) << study << " " << n << " " << full[0][i];
        if (!full[0][i].starts_with("e_") || mark) continue;
        EXPECT_EQ(to_scientific(full[n][i], 3), printed[n][i]) << study << " " << n << " " << full[0][i];
        longest = std::max(longest, full[n][i].size());
        ++compared;
      }
    }
    EXPECT_GT(compared, 6u) << study;
    EXPECT_GT(longest, 15u) << study;
  }
}

TEST_F(StudyTest, RefusesABadFolderOrFile) {
  EXPECT_THROW(run(root_ / "nothing", "double"), InputError);
  EXPECT_THROW(run_changed("table_3_conical_pendulum", "study.toml", "compare_above", "compare_abvoe"), InputError);
}

}  // namespace
}  // namespace hbvm::core

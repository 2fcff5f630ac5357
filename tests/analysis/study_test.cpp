#include "hbvm/analysis/study.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "hbvm/error.hpp"
#include "hbvm/scene/scene.hpp"

namespace hbvm {
namespace {

namespace fs = std::filesystem;

/// A copy of a study's folder, so that results do not land in the source tree.
class StudyTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* const test = ::testing::UnitTest::GetInstance()->current_test_info();
    root_ = fs::temp_directory_path() / (std::string("hbvm_study_") + test->name());
    fs::remove_all(root_);
    fs::create_directories(root_);
  }
  void TearDown() override { fs::remove_all(root_); }

  fs::path copy_of(const std::string& study) const {
    const fs::path target = root_ / study;
    fs::copy(fs::path(HBVM_SOURCE_DIR) / "studies" / study, target, fs::copy_options::recursive);
    return target;
  }

  static StudyOutcome run(const fs::path& folder, const std::string& precision) {
    return run_study(folder.string(), Precision::parse(precision), true, [](long, long) {});
  }

  static void replace(const fs::path& file, const std::string& from, const std::string& to) {
    std::ifstream in(file);
    std::string text((std::istreambuf_iterator<char>(in)), {});
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos);
    text.replace(at, from.size(), to);
    std::ofstream(file) << text;
  }

  fs::path root_;
};

TEST_F(StudyTest, AllPrintedFiguresAgreeInDouble) {
  long agreed = 0;
  for (const char* study : {"table_1_simple_pendulum", "table_2_modified_pendulum", "table_3_conical_pendulum"}) {
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
    for (const char* study : {"table_1_simple_pendulum", "table_2_modified_pendulum", "table_3_conical_pendulum"}) {
      const fs::path folder = root_ / study;
      fs::remove_all(folder);
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
    fs::remove_all(root_ / "conservation");
    const StudyOutcome outcome = run(copy_of("conservation"), precision);
    EXPECT_EQ(outcome.stated, 2 * static_cast<long>(built_in_scenes().size())) << precision;
    EXPECT_EQ(outcome.agreed, outcome.stated) << precision << ": " << outcome.complaints.front();
  }
}

TEST_F(StudyTest, AChangedVerdictIsReported) {
  const fs::path folder = copy_of("conservation");
  replace(folder / "expected.csv", "kepler,k = s,L,H", "kepler,k = s,H L,");
  const StudyOutcome outcome = run(folder, "double");
  ASSERT_EQ(outcome.complaints.size(), 1u);
  EXPECT_EQ(outcome.complaints[0], "kepler, k = s: kept 'L', lost 'H' instead of 'H L' and ''");
}

TEST_F(StudyTest, AChangedFigureIsReported) {
  const fs::path folder = copy_of("table_3_conical_pendulum");
  replace(folder / "expected.csv", "1.20e-01", "1.21e-01");
  const StudyOutcome outcome = run(folder, "double");
  EXPECT_EQ(outcome.agreed, 17);
  ASSERT_EQ(outcome.complaints.size(), 1u);
  EXPECT_NE(outcome.complaints[0].find("printed 1.21e-01"), std::string::npos);
}

TEST_F(StudyTest, AChangedRateBeyondDoubleIsReported) {
  const fs::path folder = copy_of("table_2_modified_pendulum");
  replace(folder / "study.toml", "\"2*k\"", "\"2*k+1/4\"");
  EXPECT_EQ(run(folder, "quad").complaints.size(), 7u);
}

TEST_F(StudyTest, WritesTablesAndPicturesWithProvenance) {
  const fs::path folder = copy_of("table_3_conical_pendulum");
  run(folder, "double");
  for (const char* name : {"table.csv", "table.md", "table.tex", "figure_3.svg", "figure_3_1.csv"}) {
    std::ifstream file(folder / "results" / "double" / name);
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    EXPECT_GT(text.size(), 500u) << name;
    if (std::string(name) != "figure_3.svg") {
      EXPECT_NE(text.find("hbvm study table_3_conical_pendulum --precision double"), std::string::npos) << name;
    }
  }
}

TEST_F(StudyTest, RefusesABadFolderOrFile) {
  EXPECT_THROW(run(root_ / "nothing", "double"), InputError);
  const fs::path folder = copy_of("table_3_conical_pendulum");
  replace(folder / "study.toml", "compare_above", "compare_abvoe");
  EXPECT_THROW(run(folder, "double"), InputError);
}

}  // namespace
}  // namespace hbvm

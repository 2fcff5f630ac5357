#include <filesystem>

#include "cli/program.hpp"

namespace hbvm::core {
namespace {

TEST(ReportCommand, MakesAPageOfWhatAStudyWrote) {
  const Folder folder;
  const Outcome run = hbvm({"run", "kepler", "--method", "hbvm:3,3", "--step", "1/8", "--until", "4", "--out",
                            folder / "f.csv", "--plot", folder / "f.svg"});
  ASSERT_EQ(run.code, 0) << run.err;
  const std::string where = std::filesystem::path(folder / "f.csv").parent_path().string();
  const Outcome outcome = hbvm({"report", where});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  expect_words(outcome.err, {"written to"});
  const std::string page = text_of(folder / "report.html");
  expect_words(page, {"%3Csvg", "hbvm run kepler"});
  // Once more, beside its own page, and elsewhere.
  EXPECT_EQ(hbvm({"report", where, "--out", folder / "other.html"}).code, 0);
  EXPECT_EQ(text_of(folder / "other.html").find("not shown: other"), std::string::npos);
}

TEST(ReportCommand, RefusesWhatIsNoFolderOfResults) {
  const Folder folder;
  expect_refused({"report", folder / "none"}, {"no folder", "none"});
  std::ofstream(folder / "t.csv") << "a,b\n1\n";
  expect_refused({"report", std::filesystem::path(folder / "t.csv").parent_path().string()}, {"t.csv:2", "2 columns"});
}

}  // namespace
}  // namespace hbvm::core

#include "cli/program.hpp"

namespace hbvm::core {
namespace {

TEST(ReportCommand, MakesAPageOfWhatAStudyWrote) {
  const Folder folder;
  ended_with(
      0, run_of("kepler", "hbvm:3,3", "1/8", "4") + Arguments{"--out", folder / "f.csv", "--plot", folder / "f.svg"});
  const std::string where = folder.path().string();
  expect_words(ended_with(0, {"report", where}).err, {"written to"});
  expect_words(text_of(folder / "report.html"), {"%3Csvg", "hbvm run kepler"});
  // Once more, beside its own page, and elsewhere.
  ended_with(0, {"report", where, "--out", folder / "other.html"});
  EXPECT_EQ(text_of(folder / "other.html").find("not shown: other"), std::string::npos);
}

TEST(ReportCommand, RefusesWhatIsNoFolderOfResults) {
  const Folder folder;
  expect_refused({"report", folder / "none"}, {"no folder", "none"});
  folder.write("t.csv", "a,b\n1\n");
  expect_refused({"report", folder.path().string()}, {"t.csv:2", "2 columns"});
}

}  // namespace
}  // namespace hbvm::core

#include <gtest/gtest.h>

#include <set>

#include "verification/sources.hpp"

namespace hbvm::core {
namespace {

namespace fs = std::filesystem;

/// A small wrong change that tests/mutants/run makes.
struct Change {
  std::string name, file, before, after, reason;

  /// "step" for src/step/rattle.cpp and src/step/backward_stepper.hpp, "." for src/read_file.cpp.
  std::string folder() const {
    const fs::path path = fs::path(file).lexically_relative("src");
    return path.has_parent_path() ? path.begin()->string() : ".";
  }
};

void append_line(std::string& text, const std::string& line) { text += (text.empty() ? "" : "\n") + line; }

std::vector<Change> read_changes() {
  std::vector<Change> changes;
  for (const std::string& line : lines_in(read_file(project / "tests/mutants/changes.txt"))) {
    if (line.empty() || line.starts_with('#')) continue;
    const std::string mark = line.substr(0, 2), text = line.substr(std::min<std::size_t>(2, line.size()));
    if (mark == "= ") {
      Change& change = changes.emplace_back();
      std::istringstream(text) >> change.name >> change.file;
    } else if (changes.empty() || (mark != "- " && mark != "+ " && mark != "! ")) {
      ADD_FAILURE() << "a line of the list begins with none of = - + ! #: " << line;
    } else {
      Change& change = changes.back();
      append_line(mark == "- " ? change.before : mark == "+ " ? change.after : change.reason, text);
    }
  }
  return changes;
}

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(Mutants, EachChangeStillApplies) {
  for (const Change& change : read_changes()) {
    SCOPED_TRACE(change.name + ": " + change.file);
    ASSERT_FALSE(change.before.empty());
    ASSERT_FALSE(change.after.empty());
    EXPECT_NE(change.before, change.after);
    ASSERT_TRUE(fs::is_regular_file(project / change.file));
    EXPECT_EQ(count(read_file(project / change.file), change.before), 1) << change.before;
  }
}

TEST(Mutants, AHundredInAllFolders) {
  std::set<std::string> names, folders;
  int excused = 0;
  for (const Change& change : read_changes()) {
    EXPECT_TRUE(names.insert(change.name).second) << change.name << " stands twice";
    folders.insert(change.folder());
    excused += change.reason.empty() ? 0 : 1;
  }
  EXPECT_GE(names.size(), 100U);
  EXPECT_LE(excused, 3);
  // The changes are tried with the tests in C++; those of the Python module are in Python.
  const std::set<std::string> left_out{"browser", "install", "python"};
  for (const auto& entry : fs::directory_iterator(project / "src")) {
    const std::string folder = entry.path().filename().string();
    EXPECT_TRUE(!entry.is_directory() || left_out.contains(folder) || folders.contains(folder)) << folder;
  }
}

}  // namespace
}  // namespace hbvm::core

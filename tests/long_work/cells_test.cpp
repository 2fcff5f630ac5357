#include "long_work/cells.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <random>

#include "folder.hpp"
#include "read_file.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

namespace fs = std::filesystem;

class Cells : public ::testing::Test {
 protected:
  fs::path path(const std::string& name) const { return folder_ / name; }
  std::string text(const std::string& name) const { return read_file(path(name)); }

  /// n cells whose result is their number's square, and what was run of them.
  std::vector<WorkCell> squares(int n) {
    std::vector<WorkCell> cells;
    for (int i = 0; i < n; ++i)
      cells.push_back({"cell \"" + std::to_string(i) + "\"\n", [this, i] {
                         ++runs_;
                         return "{\"square\":" + std::to_string(i * i) + ",\"text\":\"\\\",\\\"checksum\\\":\"}";
                       }});
    return cells;
  }
  static std::vector<std::string> keys(const std::vector<WorkCell>& cells) {
    std::vector<std::string> keys;
    for (const WorkCell& cell : cells) keys.push_back(cell.key);
    return keys;
  }
  /// With what the file of this name stores.
  auto run(const std::vector<WorkCell>& cells, const std::string& name, CellOptions options = {}) const {
    CellStore store(path(name));
    options.store = &store;
    return run_cells(cells, options);
  }
  /// All of them by one thread.
  std::string expected(const std::vector<WorkCell>& cells) const {
    run(cells, "expected");
    return text("expected");
  }

  Folder folder_;
  std::atomic<int> runs_ = 0;
};

TEST_F(Cells, GiveTheirResultsInOrder) {
  for (const int jobs : {1, 4}) {
    CellOptions options;
    options.jobs = jobs;
    long last = -1, total = 0;
    options.progress = [&](long done, long of) {
      EXPECT_EQ(done, ++last);
      total = of;
    };
    const auto results = run_cells(squares(50), options);
    ASSERT_EQ(results.size(), 50u);
    for (int i = 0; i < 50; ++i)
      expect_words(*results[static_cast<std::size_t>(i)], {"\"square\":" + std::to_string(i * i)});
    EXPECT_EQ(last, 50);
    EXPECT_EQ(total, 50);
  }
}

TEST_F(Cells, AreNotRunAgain) {
  const auto cells = squares(20);
  for (int n = 0; n < 2; ++n) expect_words(*run(cells, "store")[3], {"\"square\":9"});
  EXPECT_EQ(runs_, 20);
}

/// Cut off at any byte, the file is gone on from, and ends as if it had not been.
TEST_F(Cells, GoOnFromAFileCutAnywhere) {
  const auto cells = squares(12);
  const std::string whole = expected(cells);
  std::mt19937 random(7);
  for (int n = 0; n < 40; ++n) {
    const std::size_t length = random() % (whole.size() + 1);
    folder_.write("cut", whole.substr(0, length));
    runs_ = 0;
    CellOptions options;
    options.jobs = 3;
    run(cells, "cut", options);
    const auto lines = std::count(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length), '\n');
    EXPECT_LE(runs_, 12 - lines);
    EXPECT_GE(runs_, 12 - lines - 1);
    EXPECT_EQ(text("cut"), whole) << length;
  }
}

/// No line with a changed byte is taken for what it was, here or in a merge.
TEST_F(Cells, SeeDamage) {
  const auto cells = squares(3);
  const std::string whole = expected(cells);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    if (whole[i] == '\n') continue;
    std::string damaged = whole;
    damaged[i] = damaged[i] == 'x' ? 'y' : 'x';
    folder_.write("damaged", damaged);
    CellStore other(path("other"));
    EXPECT_THROW(other.merge(path("damaged")), InputError) << i;
    runs_ = 0;
    run(cells, "damaged");
    EXPECT_EQ(runs_, 1) << i;
  }
}

TEST_F(Cells, OfSevenShardsMergeToTheSameFile) {
  const auto cells = squares(50);
  const std::string whole = expected(cells);
  runs_ = 0;
  CellStore merged(path("merged"));
  for (const int i : {4, 1, 7, 2, 3, 6, 5}) {
    const std::string name = "shard" + std::to_string(i);
    CellOptions options;
    options.jobs = 2;
    options.shard = Shard::parse(std::to_string(i) + "/7");
    const auto results = run(cells, name, options);
    for (std::size_t c = 0; c < cells.size(); ++c) EXPECT_EQ(results[c].has_value(), options.shard.has(c));
    merged.merge(path(name));
  }
  EXPECT_EQ(runs_, 50);
  merged.put_in_order(keys(cells));
  EXPECT_EQ(text("merged"), whole);
}

TEST_F(Cells, ThatFailEndAllAndLoseNothing) {
  auto cells = squares(30);
  cells[9].run = []() -> std::string { throw InputError("number nine"); };
  EXPECT_EQ(message_of([&] { run(cells, "store"); }), "number nine");
  EXPECT_EQ(runs_, 9);
  const CellStore again(path("store"));
  EXPECT_TRUE(again.find(cells[8].key));
  EXPECT_FALSE(again.find(cells[9].key));
}

TEST_F(Cells, OfAnotherVersionAreNotTaken) {
  const auto cells = squares(2);
  std::string other = expected(cells);
  const std::size_t place = other.find("\"version\":\"") + 11;
  other[place] = other[place] == '9' ? '8' : '9';
  folder_.write("other", other);
  runs_ = 0;
  run(cells, "other");
  EXPECT_EQ(runs_, 1);
}

/// A runner hands over what it likes, when it likes.
TEST_F(Cells, CanBeRunByOtherThanThreads) {
  const auto cells = squares(7);
  const std::string whole = expected(cells);
  runs_ = 0;
  CellStore store(path("store"));
  CellOptions options;
  options.store = &store;
  options.shard = Shard::parse("2/2");
  long last = 0;
  options.progress = [&](long done, long) { last = done; };
  const auto results = run_cells(cells, options, [&](const std::vector<std::size_t>& open, const TakeResult& take) {
    EXPECT_EQ(open, (std::vector<std::size_t>{1, 3, 5}));
    for (auto i = open.rbegin(); i != open.rend(); ++i) take(*i, cells[*i].run());
  });
  EXPECT_EQ(last, 3);
  EXPECT_EQ(runs_, 3);
  for (std::size_t i = 0; i < cells.size(); ++i) EXPECT_EQ(results[i].has_value(), i % 2 == 1);
  options.shard = {};
  run_cells(cells, options);
  EXPECT_EQ(text("store"), whole);
}

TEST_F(Cells, CanBeStoredWithoutAFile) {
  const auto cells = squares(3);
  CellStore store;
  CellOptions options;
  options.store = &store;
  for (int n = 0; n < 2; ++n) run_cells(cells, options);
  EXPECT_EQ(runs_, 3);
  EXPECT_NE(store.find(cells[2].key), nullptr);
}

TEST_F(Cells, RefuseFilesThatCannotBe) {
  EXPECT_THROW(CellStore(path("no such folder") / "store"), InputError);
  CellStore store(path("store"));
  EXPECT_THROW(store.merge(path("absent")), InputError);
}

TEST(Shards, DivideTheCells) {
  const Shard third = Shard::parse("3/7");
  EXPECT_EQ(third.text(), "3/7");
  EXPECT_TRUE(third.has(2));
  EXPECT_TRUE(third.has(9));
  EXPECT_FALSE(third.has(0));
  EXPECT_TRUE(Shard().has(5));
  for (const char* const text : {"", "3", "0/7", "8/7", "-1/7", "3/7x", "a/b", "3/", "/7", "3/99999999999"})
    EXPECT_THROW(Shard::parse(text), InputError) << text;
}

}  // namespace
}  // namespace hbvm::core

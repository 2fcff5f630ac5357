#include "integrate/csv_file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "folder.hpp"
#include "hbvm/error.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

class CsvFiles : public ::testing::Test {
 protected:
  const Folder folder_;
  const std::string path_ = folder_.write("file.csv", "");
  std::string text() const { return text_of(path_); }
};

TEST_F(CsvFiles, HaveOneWriter) {
  {
    CsvFile file(path_, CsvFile::Opening::anew);
    file << "1,2\n";
    EXPECT_THROW(CsvFile(path_, CsvFile::Opening::anew), InputError);
    EXPECT_THROW(CsvFile(path_, CsvFile::Opening::to_go_on), InputError);
  }
  EXPECT_EQ(text(), "1,2\n") << "whoever was refused has cut nothing";
  { CsvFile file(path_, CsvFile::Opening::anew); }
  EXPECT_EQ(text(), "");
}

TEST_F(CsvFiles, HoldCompleteLinesOnly) {
  std::string expected;
  {
    CsvFile file(path_, CsvFile::Opening::anew);
    for (int i = 0; i < 20'000; ++i) {
      const std::string line = std::to_string(i) + ",1.5,abc";
      file << line << '\n';
      expected += line + "\n";
      if (i % 3'000 == 0) {
        file << "cut";
        file.flush();
        EXPECT_TRUE(text() == expected) << i;
        file << ',' << "whole\n";
        expected += "cut,whole\n";
      }
    }
    file << "never ended";
  }
  EXPECT_TRUE(text() == expected);
}

TEST_F(CsvFiles, GoOnWhereTheyWere) {
  Archive writing;
  {
    CsvFile file(path_, CsvFile::Opening::anew);
    file << "one\ntwo\n";
    writing(file);
    file << "three\n";
  }
  EXPECT_EQ(text(), "one\ntwo\nthree\n");
  const auto go_on = [&] {
    CsvFile file(path_, CsvFile::Opening::to_go_on);
    Archive reading(writing.text());
    reading(file);
    Archive again;
    again(file);
    EXPECT_EQ(again.text(), writing.text());
    file << "four\n";
  };
  go_on();
  EXPECT_EQ(text(), "one\ntwo\nfour\n");
  std::ofstream(path_) << "one\ntwo\nthr";
  go_on();
  EXPECT_EQ(text(), "one\ntwo\nfour\n");
  for (const char* other : {"one\ntwo", "", "one\ntoo\nthree\n"}) {
    std::ofstream(path_) << other;
    EXPECT_THROW(go_on(), InputError) << other;
    EXPECT_EQ(text(), other);
  }
  std::filesystem::remove(path_);
  EXPECT_THROW(go_on(), InputError);
}

TEST_F(CsvFiles, EndWithACompleteLineOnAFullDisk) {
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  for (const rlim_t room : {1, 9, 10, 11, 105, 70'000, 140'003}) {
    std::filesystem::resize_file(path_, 0);
    rlimit limit = before;
    limit.rlim_cur = room;
    setrlimit(RLIMIT_FSIZE, &limit);
    expect_words(message_of([&] {
                   CsvFile file(path_, CsvFile::Opening::anew);
                   for (int i = 0; i < 20'000; ++i) file << "123456789\n";
                   file.flush();
                 }),
                 {path_});
    setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_EQ(text().size(), room / 10 * 10);
  }
}

TEST_F(CsvFiles, ThatCannotBeCutAreNotKept) {
  CsvFile file("/dev/null", CsvFile::Opening::anew);
  file << "one\n";
  Archive writing;
  EXPECT_THROW(writing(file), InputError);
  CsvFile full("/dev/full", CsvFile::Opening::anew);
  full << "one\n";
  EXPECT_THROW(full.flush(), InputError);
  EXPECT_THROW(CsvFile("/nonexistent/file", CsvFile::Opening::anew), InputError);
}

}  // namespace
}  // namespace hbvm::core

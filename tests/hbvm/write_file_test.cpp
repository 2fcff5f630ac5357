#include "write_file.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include "hbvm/error.hpp"
#include "read_file.hpp"

namespace hbvm::core {
namespace {

class WriteFile : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(mkdtemp(folder_.data())); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string folder_ = (std::filesystem::temp_directory_path() / "hbvm_write_file_XXXXXX").string();
};

TEST_F(WriteFile, ReplacesWhatWasThere) {
  const std::string path = folder_ + "/file";
  for (const std::string& text : {std::string(100'000, 'x'), std::string("a\r\n\0b", 5), std::string()}) {
    write_file(path, text);
    EXPECT_TRUE(read_file(path) == text) << text.size();
  }
}

TEST_F(WriteFile, RefusesWhatCannotBeWrittenByItsName) {
  for (const std::string& path : {folder_ + "/none/file", folder_, std::string("/dev/full")}) {
    try {
      write_file(path, "text");
      ADD_FAILURE() << path;
    } catch (const InputError& error) {
      EXPECT_EQ(error.what(), "cannot write '" + path + "'");
    }
  }
}

}  // namespace
}  // namespace hbvm::core

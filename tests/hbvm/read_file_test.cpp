#include "read_file.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <fstream>

#include "hbvm/error.hpp"

namespace hbvm::core {
namespace {

class ReadFile : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(mkdtemp(folder_.data())); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string folder_ = (std::filesystem::temp_directory_path() / "hbvm_read_file_XXXXXX").string();
};

TEST_F(ReadFile, GivesAllBytes) {
  for (const std::size_t size : {0u, 1u, 1000u, 65535u, 65536u, 65537u, 200000u}) {
    std::string bytes(size, '\0');
    for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<char>(i * i >> 3);
    const std::string path = folder_ + "/bytes";
    std::ofstream(path, std::ios::binary) << bytes;
    EXPECT_TRUE(read_file(path) == bytes) << size;
  }
}

TEST_F(ReadFile, RefusesWhatCannotBeReadByItsName) {
  for (const std::string& path : {folder_ + "/none", folder_}) {
    try {
      read_file(path);
      ADD_FAILURE() << path;
    } catch (const InputError& error) {
      EXPECT_EQ(error.what(), "cannot read '" + path + "'");
    }
  }
}

}  // namespace
}  // namespace hbvm::core

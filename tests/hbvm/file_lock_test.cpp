#include "file_lock.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>

#include "hbvm/error.hpp"

namespace hbvm::core {
namespace {

TEST(FileLock, HasOneHolder) {
  const std::string file = (std::filesystem::temp_directory_path() / "hbvm_file_lock_test.txt").string();
  std::optional<FileLock> first(file);
  try {
    const FileLock second(file);
    ADD_FAILURE() << "it is held";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find("'" + file + "' is being written by another run"), 0u) << error.what();
  }
  first.reset();
  EXPECT_NO_THROW(FileLock{file});
  std::filesystem::remove(file);
  EXPECT_THROW(FileLock{"/nowhere/at/all"}, InputError);
}

TEST(FileLock, MayBeOfAFolder) {
  const std::string folder = (std::filesystem::temp_directory_path() / "hbvm_file_lock_test").string();
  std::filesystem::create_directory(folder);
  {
    const FileLock first(folder);
    EXPECT_THROW(FileLock{folder}, InputError);
  }
  EXPECT_NO_THROW(FileLock{folder});
  std::filesystem::remove(folder);
}

TEST(FileLock, OfADeviceIsNone) {
  const FileLock one("/dev/null");
  EXPECT_NO_THROW(FileLock("/dev/null"));
}

}  // namespace
}  // namespace hbvm::core

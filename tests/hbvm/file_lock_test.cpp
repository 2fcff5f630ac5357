#include "file_lock.hpp"

#include <gtest/gtest.h>

#include <optional>

#include "folder.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

TEST(FileLock, HasOneHolder) {
  const Folder folder;
  const std::string file = folder / "test.txt";
  std::optional<FileLock> first(file);
  const std::string refused = message_of([&] { const FileLock second(file); });
  EXPECT_TRUE(refused.starts_with("'" + file + "' is being written by another run")) << refused;
  first.reset();
  EXPECT_NO_THROW(FileLock{file});
  EXPECT_THROW(FileLock{"/nowhere/at/all"}, InputError);
}

TEST(FileLock, MayBeOfAFolder) {
  const Folder one;
  const std::string folder = one / ".";
  {
    const FileLock first(folder);
    EXPECT_THROW(FileLock{folder}, InputError);
  }
  EXPECT_NO_THROW(FileLock{folder});
}

TEST(FileLock, OfADeviceIsNone) {
  const FileLock one("/dev/null");
  EXPECT_NO_THROW(FileLock("/dev/null"));
}

}  // namespace
}  // namespace hbvm::core

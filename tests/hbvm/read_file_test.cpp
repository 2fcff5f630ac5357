#include "read_file.hpp"

#include <gtest/gtest.h>

#include "folder.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

TEST(ReadFile, GivesAllBytes) {
  const Folder folder;
  for (const std::size_t size : {0u, 1u, 1000u, 65535u, 65536u, 65537u, 200000u}) {
    std::string bytes(size, '\0');
    for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<char>(i * i >> 3);
    EXPECT_TRUE(read_file(folder.write("bytes", bytes)) == bytes) << size;
  }
}

TEST(ReadFile, RefusesWhatCannotBeReadByItsName) {
  const Folder folder;
  for (const std::string& path : {folder / "none", folder / "."})
    EXPECT_EQ(message_of([&] { read_file(path); }), "cannot read '" + path + "'");
}

}  // namespace
}  // namespace hbvm::core

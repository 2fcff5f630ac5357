#include "write_file.hpp"

#include <gtest/gtest.h>

#include "folder.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

TEST(WriteFile, ReplacesWhatWasThere) {
  const Folder folder;
  const std::string path = folder / "file";
  for (const std::string& text : {std::string(100'000, 'x'), std::string("a\r\n\0b", 5), std::string()}) {
    write_file(path, text);
    EXPECT_TRUE(text_of(path) == text) << text.size();
  }
}

TEST(WriteFile, RefusesWhatCannotBeWrittenByItsName) {
  const Folder folder;
  for (const std::string& path : {folder / "none/file", folder / ".", std::string("/dev/full")})
    EXPECT_EQ(message_of([&] { write_file(path, "text"); }), "cannot write '" + path + "'");
}

}  // namespace
}  // namespace hbvm::core

#include "checksum.hpp"

#include <gtest/gtest.h>

namespace hbvm::core {
namespace {

/// The values that the authors of FNV-1a publish.
TEST(Checksums, AreThoseOfFnv1a) {
  EXPECT_EQ(Checksum("").text(), "cbf29ce484222325");
  EXPECT_EQ(Checksum("a").text(), "af63dc4c8601ec8c");
  EXPECT_EQ(Checksum("foobar").text(), "85944171f73967e8");
}

TEST(Checksums, OfPartsIsThatOfTheWhole) {
  Checksum sum;
  for (const char* const part : {"fo", "", "oba", "r"}) sum.add(part);
  EXPECT_EQ(sum, Checksum("foobar"));
}

TEST(Checksums, NoticeEveryChangeOfAByte) {
  const std::string text("energy\0\xFF conserving", 19);
  for (std::size_t i = 0; i < text.size(); ++i)
    for (int bit = 0; bit < 8; ++bit) {
      std::string other = text;
      other[i] = static_cast<char>(other[i] ^ (1 << bit));
      EXPECT_NE(Checksum(other), Checksum(text)) << i << ", bit " << bit;
    }
}

}  // namespace
}  // namespace hbvm::core

#include "toml/toml_flaw.hpp"

#include <gtest/gtest.h>

namespace hbvm::core {
namespace {

constexpr const char* sound[] = {
    "",
    "a = 1\nb.c = \"x\" # \xC3\xA4\n",
    "\"\xC3\xA4\" = '\xC3\xA4'\n",
    "a = [1, [2, 3], { b = 4, c = \"]\" }]\n[t]\n[[u]]\n",
    "a = \"\"\"one\\\n   two \"\" three\"\"\"\"\"\nb = 1\n",
    "a = '''it's \\'''\nb = 1\n",
    "a = \"\\\"\"\nb = \"\\\\\"\n",
    "a = \"1.2.3\" # ........................................................................\n",
    "a = [\n1,\n2 ]\nb = { c = 1, d = 2 }\n",
};

TEST(TomlFlaws, SoundTextsHaveNone) {
  for (const char* const text : sound) {
    const auto flaw = find_flaw(text);
    EXPECT_FALSE(flaw) << text << ": " << flaw->what;
  }
}

void expect_flaw(const std::string& text, std::size_t line, const char* part) {
  const auto flaw = find_flaw(text);
  ASSERT_TRUE(flaw) << text;
  EXPECT_EQ(flaw->line, line) << text;
  EXPECT_NE(flaw->what.find(part), std::string::npos) << flaw->what;
}

TEST(TomlFlaws, KeysOfManyPartsAreOne) {
  const auto dotted = [](int dots, const char* part) {
    std::string key = part;
    for (int n = 0; n < dots; ++n) key += std::string(".") + part;
    return key + " = 1\n";
  };
  for (const char* const part : {"a", "\"a\""}) {
    EXPECT_FALSE(find_flaw("\n" + dotted(64, part) + dotted(64, part)));
    expect_flaw("\n" + dotted(65, part), 2, "64 parts");
  }
}

TEST(TomlFlaws, CharactersBeyondAsciiStandInQuotesAndComments) {
  for (const char* const text : {"a = 1\n\xC3\xA4 = 1\n", "\na = \xC3\xA4\n", "\n[\xC3\xA4]\n",
                                 "\na.\"\xC3\xA4\" = 1\n", "\na = \"x\" \xC3\xA4\n"})
    expect_flaw(text, 2, "beyond ASCII");
  expect_flaw("a = \"\"\"b\\\n  \xC3\xA4\"\"\"\n", 2, "joins lines");
  EXPECT_FALSE(find_flaw("a = \"\"\"b\\\n  b\xC3\xA4\"\"\"\n"));
}

/// Where the parser would read on a word, a bracket or quote is none that opens anything.
TEST(TomlFlaws, QuotesAndBracketsDoNotGoOnAWord) {
  expect_flaw("a = x\"b\"\n", 1, "quote");
  expect_flaw("a = 1'b'\n", 1, "quote");
  expect_flaw("\na = 1[\n", 2, "'['");
  expect_flaw("a = x{\n", 1, "'{'");
  expect_flaw("a = b = 1\n", 1, "'='");
  expect_flaw("a = [b = 1]\n", 1, "'='");
  EXPECT_FALSE(find_flaw("a = { b = 1, c = 2 }\nd = 1\n"));
}

/// The text ends inside: no reading beyond it.
TEST(TomlFlaws, AnyBeginningEnds) {
  for (const std::string text : sound)
    for (std::size_t length = 0; length < text.size(); ++length) static_cast<void>(find_flaw(text.substr(0, length)));
  EXPECT_FALSE(find_flaw("a = \"open\nb = 1\n")) << "a string ends with its line";
}

}  // namespace
}  // namespace hbvm::core

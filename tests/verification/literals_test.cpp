#include <gtest/gtest.h>

#include "verification/cpp_text.hpp"
#include "verification/sources.hpp"

namespace hbvm::core {
namespace {

/// The floating literals of C++ code, and the constants of <cmath> that are doubles. Comments and strings hold none.
std::vector<Occurrence> floating_literals(const std::string& source) {
  const std::string text = only(CppPart::code, source);
  std::vector<Occurrence> result;
  std::size_t line = 1, at = 0;
  const auto peek = [&](std::size_t ahead) { return at + ahead < text.size() ? text[at + ahead] : '\0'; };
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto is_name = [&](char c) {
    return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
  };
  while (at < text.size()) {
    const char c = text[at];
    std::size_t end = at + 1;
    if (is_digit(c) || (c == '.' && is_digit(peek(1)))) {
      const auto signs_exponent = [&] { return std::string("eEpP").find(text[end - 1]) != std::string::npos; };
      while (end < text.size() && (is_name(text[end]) || text[end] == '.' || text[end] == '\'' ||
                                   ((text[end] == '+' || text[end] == '-') && signs_exponent())))
        ++end;
      const std::string number = text.substr(at, end - at);
      const bool hexadecimal = number.starts_with("0x") || number.starts_with("0X");
      if (number.find_first_of(hexadecimal ? ".pP" : ".eE") != std::string::npos) result.push_back({line, number});
    } else if (is_name(c)) {
      while (end < text.size() && is_name(text[end])) ++end;
      const std::string name = text.substr(at, end - at);
      for (const char* constant :
           {"M_PI", "M_PI_2", "M_PI_4", "M_1_PI", "M_2_PI", "M_E", "M_LN2", "M_LN10", "M_SQRT2", "M_SQRT1_2"})
        if (name == constant) result.push_back({line, name});
    }
    line += c == '\n';
    at = end;
  }
  return result;
}

TEST(FloatingLiterals, AreFoundByTheSearch) {
  const auto found = [](const std::string& text) { return listed(floating_literals(text)); };
  EXPECT_EQ(found("x = 0.5 + 1e-12 - .5f*2.;"), "1:0.5 1:1e-12 1:.5f 1:2. ");
  EXPECT_EQ(found("a\n/* 0.5\n*/ 1.5 // 2.5\n3e4"), "3:1.5 4:3e4 ");
  EXPECT_EQ(found("f(\"0.1\", '\\'', '\"', R\"x(0.2\")x\", 0.3)"), "1:0.3 ");
  EXPECT_EQ(found("10'000 + 0x1e5 + x1e5 + p.first + 0x1p-3 + 7u + v[1].x + 1'0.5"), "1:0x1p-3 1:1'0.5 ");
  EXPECT_EQ(found("2 * M_PI + M_PIE"), "1:M_PI ");
}

/// Generic code works in the scalar of the caller: a literal of 17 digits has no place in it. The program and the
/// reports, which only display, may use double.
TEST(FloatingLiterals, AreNotInGenericCode) {
  std::size_t files = 0;
  for (const Source& source : sources()) {
    if (source.folder == "cli" || source.folder.ends_with("report")) continue;
    ++files;
    for (const Occurrence& token : floating_literals(source.text))
      ADD_FAILURE() << source.place(token.line) << ": " << token.text;
  }
  EXPECT_GT(files, 50u);
}

}  // namespace
}  // namespace hbvm::core

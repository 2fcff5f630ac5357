#include "method/method_spec.hpp"

#include <gtest/gtest.h>

namespace hbvm::core {
namespace {

TEST(MethodSpec, IsAFamilyAndItsArguments) {
  for (const auto& [text, family, arguments] : {std::tuple("hbvm:4,2", "hbvm", "4,2"),
                                                {"rattle", "rattle", ""},
                                                {"tableau:a:b.toml", "tableau", "a:b.toml"},
                                                {"rk4+project", "rk4", "+project"},
                                                {"rk4+baumgarte:5,5", "rk4", "+baumgarte:5,5"},
                                                {"sdirk:3+project", "sdirk", "3+project"}}) {
    const MethodSpec spec = MethodSpec::parse(text);
    EXPECT_EQ(spec.family, family);
    EXPECT_EQ(spec.arguments, arguments);
    EXPECT_EQ(spec.text(), text);
  }
}

TEST(MethodSpec, ReadsWholeNumbers) {
  EXPECT_EQ(whole_number("12"), 12);
  EXPECT_EQ(whole_number("-3"), -3);
  for (const char* const text : {"", " 1", "1 ", "1.5", "x", "+1", "99999999999"})
    EXPECT_FALSE(whole_number(text)) << text;
}

}  // namespace
}  // namespace hbvm::core

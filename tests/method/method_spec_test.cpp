#include "method/method_spec.hpp"

#include <gtest/gtest.h>

namespace hbvm::core {
namespace {

TEST(MethodSpec, IsAFamilyAndItsArguments) {
  for (const auto& [text, family, arguments] :
       {std::tuple("hbvm:4,2", "hbvm", "4,2"), {"rattle", "rattle", ""}, {"tableau:a:b.toml", "tableau", "a:b.toml"}}) {
    const MethodSpec spec = MethodSpec::parse(text);
    EXPECT_EQ(spec.family, family);
    EXPECT_EQ(spec.arguments, arguments);
    EXPECT_EQ(spec.text(), text);
  }
}

}  // namespace
}  // namespace hbvm::core

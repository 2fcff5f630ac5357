#include "long_work/json.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "words.hpp"

namespace hbvm::core {
namespace {

TEST(JsonNumbers, ThatJsonLacksAreNull) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double x : {infinity, -infinity, std::nan("")}) {
    EXPECT_EQ(dumped(json_number(x), -1), "null");
    EXPECT_TRUE(std::isnan(number_of(json_number(x))));
  }
}

TEST(JsonNumbers, AreReadBackToTheLastBit) {
  for (const double x : {double{0}, 1 / double{3}, -std::ldexp(1, -1074), std::numeric_limits<double>::max()})
    EXPECT_EQ(number_of(OrderedJson::parse(dumped(json_number(x), -1))), x);
}

TEST(JsonText, IsTextWhateverTheNames) {
  const std::string text = dumped({{"file", "a\xFF.toml"}, {"b", 1}}, -1);
  EXPECT_EQ(text, "{\"file\":\"a\xEF\xBF\xBD.toml\",\"b\":1}");
  EXPECT_EQ(dumped({{"b", 1}}, 2), "{\n  \"b\": 1\n}");
}

TEST(JsonText, OfAnotherKindIsRefused) {
  const auto read = [](const std::string& text) {
    return read_json(text, "a test", [](const OrderedJson& j) { return j.at("x").get<int>(); });
  };
  EXPECT_EQ(read("{\"x\": 3}"), 3);
  for (const char* const text : {"", "{", "[]", "{\"y\": 3}", "{\"x\": \"3\"}"}) {
    const std::string refusal = message_of([&] { read(text); });
    EXPECT_TRUE(refusal.starts_with("this is no result of a test: ")) << text << refusal;
  }
}

}  // namespace
}  // namespace hbvm::core

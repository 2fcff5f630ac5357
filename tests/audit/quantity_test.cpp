#include "audit/quantity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "words.hpp"

namespace hbvm::core {
namespace {

std::vector<Quantity> all_quantities() {
  std::vector<Quantity> all;
  for (int n = 0; n <= static_cast<int>(Quantity::W); ++n) all.push_back(static_cast<Quantity>(n));
  return all;
}

TEST(Quantities, NamesAreReadBack) {
  std::set<std::string_view> names;
  for (const Quantity quantity : all_quantities()) {
    const std::string name(name_of(quantity));
    EXPECT_FALSE(name.empty()) << static_cast<int>(quantity);
    EXPECT_TRUE(names.insert(name_of(quantity)).second) << name << " twice";
    EXPECT_EQ(parse_quantity(name), quantity) << name;
  }
}

TEST(Quantities, BlanksMayBeUnderscoresOrHyphens) {
  for (const Quantity quantity : all_quantities())
    for (const char separator : {'_', '-'}) {
      std::string name(name_of(quantity));
      std::replace(name.begin(), name.end(), ' ', separator);
      EXPECT_EQ(parse_quantity(name), quantity) << name;
    }
  EXPECT_EQ(parse_quantity("tangential_p"), Quantity::tangential_p);
  EXPECT_EQ(parse_quantity("angular-momentum"), Quantity::angular_momentum);
}

TEST(Quantities, MomentumIsTheRawOne) { EXPECT_EQ(parse_quantity("p"), Quantity::p); }

TEST(Quantities, UnknownAreRefusedWithTheKnown) {
  for (const char* const unknown : {"energy", "", "Q", "raw  p", "raw p ", "u"}) {
    const std::string message = message_of([&] { parse_quantity(unknown); });
    EXPECT_NE(message.find("'" + std::string(unknown) + "'"), std::string::npos) << message;
    for (const Quantity quantity : all_quantities())
      EXPECT_NE(message.find(name_of(quantity)), std::string::npos) << name_of(quantity) << " is not in " << message;
  }
}

}  // namespace
}  // namespace hbvm::core

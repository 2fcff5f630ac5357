#include "section/starts.hpp"

#include <gtest/gtest.h>

#include "printing.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

std::vector<double> values(const std::string& text) {
  std::vector<double> result;
  for (const Expression& value : parse_starts(text).values) result.push_back(evaluate<double>(value));
  return result;
}

TEST(Starts, AreAtEqualDistancesOrListed) {
  EXPECT_EQ(values("y=-1:1:5"), (std::vector<double>{-1, -0.5, 0, 0.5, 1}));
  EXPECT_EQ(values("y=1/2:3:1"), (std::vector<double>{0.5}));
  EXPECT_EQ(values("y=3,1/4"), (std::vector<double>{3, 0.25}));
  EXPECT_EQ(values("y=atan2(0, 1),1"), (std::vector<double>{0, 1}));
  EXPECT_EQ(parse_starts("a.mass=1,2").name, "a.mass");
}

TEST(Starts, AreRefused) {
  for (const char* const text :
       {"y", "=1:2:3", "y=1:2", "y=1:2:0", "y=1:2:x", "y=1:2:3:4", "y=1:2:20000", "y=", "y=1:2:2.5"})
    EXPECT_THROW(parse_starts(text), InputError) << text;
  const Scene scene = load_scene("double_pendulum");
  EXPECT_THROW(starts_of(scene, {parse_starts("none=1,2")}), InputError);
  EXPECT_THROW(starts_of(scene, {parse_starts("a.mass=1,2"), parse_starts("a.mass=3")}), InputError);
  EXPECT_THROW(starts_of(scene, {parse_starts("a.mass=1:2:200"), parse_starts("b.mass=1:2:200")}), InputError);
}

TEST(Starts, AreAllCombinations) {
  const std::vector<VariedScene> starts =
      starts_of(load_scene("double_pendulum"), {parse_starts("a.mass=1,2"), parse_starts("b.mass=3,4,5")});
  ASSERT_EQ(starts.size(), 6u);
  EXPECT_EQ(starts[1].near(), (std::vector<double>{1, 4}));
  EXPECT_EQ(starts[5].near(), (std::vector<double>{2, 5}));
  EXPECT_EQ(starts_of(load_scene("double_pendulum"), {}).size(), 1u);
}

}  // namespace
}  // namespace hbvm::core

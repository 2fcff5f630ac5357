#include "scene/varied_scene.hpp"

#include <gtest/gtest.h>

#include "printing.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

/// The ends are what they are, and a third is no rounded number.
TEST(VariedScenes, HaveExactValuesAtEqualDistances) {
  const std::vector<Expression> values = values_between(Expression::parse("1/3"), Expression::parse("-1"), 3);
  ASSERT_EQ(values.size(), 3u);
  const PrecisionScope scope(60);
  EXPECT_EQ(evaluate<Mpfr>(values[0]), Mpfr(1) / 3);
  EXPECT_EQ(evaluate<Mpfr>(values[2]), -1);
  EXPECT_LE(magnitude(Mpfr(evaluate<Mpfr>(values[1]) + Mpfr(1) / 3)), epsilon<Mpfr>());
}

TEST(VariedScenes, AreAllCombinationsTheLastNumberTheFastest) {
  const auto numbers = [](const char* name, std::initializer_list<const char*> values) {
    VariedNumber number{name, {}};
    for (const char* const value : values) number.values.push_back(Expression::parse(value));
    return number;
  };
  const Scene scene = load_scene("double_pendulum");
  const std::vector<VariedScene> all =
      varied_scenes(scene, {numbers("a.mass", {"1", "2"}), numbers("b.mass", {"3", "1/2", "5"})});
  ASSERT_EQ(all.size(), 6u);
  EXPECT_EQ(all[1].near(), (std::vector<double>{1, 0.5}));
  EXPECT_EQ(all[3].near(), (std::vector<double>{2, 3}));
  EXPECT_EQ(all[3].scene.bodies[0].mass->text(), "2");
  EXPECT_EQ(varied_scenes(scene, {}).size(), 1u);
  EXPECT_THROW(varied_scenes(scene, {numbers("none", {"1"})}), InputError);
}

}  // namespace
}  // namespace hbvm::core

#include "scene/own_precision.hpp"

#include "printing.hpp"
#include "scene/scene_text.hpp"

namespace hbvm::core {
namespace {

std::string pendulum_at(const std::string& position, const std::string& velocity = "[0, 0]") {
  return "dimension = 2\n[[point]]\nname = \"o\"\nposition = [0.12345678901234567, 0]\n[[body]]\nname = \"a\"\nmass = "
         "1\nposition = " +
         position + "\nvelocity = " + velocity + "\n";
}

int digits_of(const std::string& text) { return own_digits(read_scene(text, "test.toml")); }

TEST(OwnDigits, AreTheMostOfADecimalOfTheStart) {
  EXPECT_EQ(digits_of(pendulum_at("[0.6, -0.8]")), 0) << "a fixed point is no start";
  EXPECT_EQ(digits_of(pendulum_at("[0.70710678118655, 0]")), 0) << "14";
  EXPECT_EQ(digits_of(pendulum_at("[0.707106781186548, 0]")), 15);
  EXPECT_EQ(digits_of(pendulum_at("[1, 0]", "[0, -0.0007071067811865476]")), 16);
  EXPECT_EQ(digits_of(pendulum_at("[\"7.0710678118654752440e-1\", 0]")), 20);
  EXPECT_EQ(digits_of(pendulum_at("[\"sqrt(2)/2 + 0.00000000000000000000\", 0]")), 0) << "an expression";
}

TEST(OwnPrecision, IsNoFinerThanThatOfTheScalar) {
  const PrecisionScope digits(50);
  const Scene scene = read_scene(pendulum_at("[0.707106781186548, 0]"), "test.toml");
  EXPECT_EQ(own_precision<double>(scene), 1e-14);
  EXPECT_EQ(own_precision<Mpfr>(scene), literal<Mpfr>("1e-14"));
  const Scene more = read_scene(pendulum_at("[\"0.70710678118654752440\", 0]"), "test.toml");
  EXPECT_EQ(own_precision<double>(more), epsilon<double>());
  EXPECT_EQ(own_precision<Mpfr>(more), literal<Mpfr>("1e-19"));
  const Scene few = read_scene(pendulum_at("[0.6, -0.8]"), "test.toml");
  EXPECT_EQ(own_precision<Mpfr>(few), epsilon<Mpfr>());
}

}  // namespace
}  // namespace hbvm::core

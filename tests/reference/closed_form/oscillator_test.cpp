#include "reference/closed_form/against_taylor.hpp"

namespace hbvm::core {
namespace {

constexpr const char* oscillator_name = "harmonic oscillators";

/// Three bodies, one with a full mass matrix; springs between them and to a point, a trap and a field.
std::string net(Fractions& random, int dimension, const std::string& more = "") {
  const std::string full =
      dimension == 2 ? "[[2, \"1/3\"], [\"1/3\", 1]]" : "[[2, \"1/3\", 0], [\"1/3\", 1, 0], [0, 0, 5]]";
  std::string text = "dimension = " + std::to_string(dimension) + "\n" + point("wall", random.vector(dimension));
  for (const char* name : {"a", "b", "c"})
    text += body(name, name[0] == 'b' ? full : "\"" + random.positive() + "\"", random.vector(dimension),
                 random.vector(dimension));
  for (const char* ends : {"[[\"wall\", \"a\"]]", "[[\"a\", \"b\"], [\"b\", \"c\"]]"})
    text += effect("spring", "stiffness = \"" + random.positive() + "\"\nbetween = " + ends);
  return text + effect("trap", "exponent = 2\non = [\"c\"]\ncenter = \"wall\"\nstiffness = \"" + random.any() + "\"") +
         field(random.vector(dimension)) + more;
}

/// With a trap of any sign: it may be a hill.
TEST(Oscillator, AnyNetOfSprings) {
  Fractions random(31);
  for (int dimension : {2, 3})
    for (int n = 0; n < 4; ++n) expect_follows_taylor(net(random, dimension), oscillator_name, {"1/3", "8"}, 40, 12);
}

std::string free(int dimension, const std::string& more) {
  Fractions random(32);
  std::string text = "dimension = " + std::to_string(dimension) + "\n" + point("o", random.vector(dimension));
  for (const char* name : {"a", "b"})
    text += body(name, "\"" + random.positive() + "\"", random.vector(dimension), random.vector(dimension));
  return text + more;
}

TEST(Oscillator, FreeMotionAndFall) {
  for (const std::string& scene : {free(3, ""), free(2, field("[\"1/3\", -9]"))})
    expect_follows_taylor(scene, "motion under constant forces", {"1", "1000"});
}

/// Two bodies that a spring alone holds: four modes of six have the frequency 0, and three are alike.
TEST(Oscillator, ModesOfEqualAndOfNoFrequency) {
  expect_follows_taylor(free(3, effect("spring", "stiffness = 40")), oscillator_name, {"1", "100"}, 40, 11);
}

/// One stiff spring beside a weak one: 10^12 apart.
TEST(Oscillator, OfUnevenStiffness) {
  const std::string springs =
      effect("spring", "stiffness = \"1e6\"") + effect("trap", "center = \"o\"\nexponent = 2\nstiffness = \"1e-6\"");
  expect_follows_taylor(free(2, springs), oscillator_name, {"1/3"}, 40, 12);
}

TEST(Oscillator, NothingElseMayAct) {
  Fractions random(33);
  const std::string a_and_c = "between = [[\"a\", \"c\"]]\n";
  for (const auto& [dimension, other] :
       {std::pair(2, effect("trap", "exponent = 4\ncenter = \"wall\"\nstiffness = \"1e-30\"")),
        {2, effect("spring", a_and_c + "stiffness = 1\nrest_length = \"1e-9\"")},
        {3, effect("spring", a_and_c + "stiffness = 1\nexponent = 3")},
        {2, effect("mutual_gravity", a_and_c + "strength = \"1e-20\"")}})
    expect_unknown(net(random, dimension, other));
  expect_unknown("dimension = 2\n" + body("a", "1", "[0, 0]", "[1, 0]") + plane("a", "[0, 1]", "0"));
}

TEST(Oscillator, HasAThousandDigits) {
  Fractions random(34);
  expect_solves_equations(net(random, 2), {"10"}, 1000);
}

}  // namespace
}  // namespace hbvm::core

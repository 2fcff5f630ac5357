#include "reference/closed_form/against_taylor.hpp"

namespace hbvm::core {
namespace {

constexpr const char* kepler_name = "Kepler";

std::string planet(int dimension, const std::string& position, const std::string& velocity, const std::string& mass,
                   const std::string& effect, const std::string& center = "") {
  const std::string origin = center.empty() ? dimension == 2 ? "[0, 0]" : "[0, 0, 0]" : center;
  return "dimension = " + std::to_string(dimension) + "\n[[point]]\nname = \"sun\"\ncharge = -2\nposition = " + origin +
         "\n[[body]]\nname = \"planet\"\ncharge = \"3/7\"\nmass = " + mass + "\nposition = " + position +
         "\nvelocity = " + velocity + "\n" + effect;
}

std::string sun(const std::string& strength) {
  return "[[effect]]\nkind = \"central_gravity\"\ncenter = \"sun\"\nstrength = \"" + strength + "\"\n";
}

TEST(Kepler, EllipsesAndHyperbolasInAnyUnits) {
  Fractions random(21);
  for (int dimension : {2, 3})
    for (int n = 0; n < 4; ++n)
      expect_follows_taylor(planet(dimension, random.vector(dimension), random.vector(dimension),
                                   "\"" + random.positive() + "\"", sun(random.positive()), random.vector(dimension)),
                            kepler_name, {"1/3", "5"}, 40, 12);
  expect_follows_taylor(planet(2, "[7000, 300]", "[\"1/3\", 8]", "5", sun("398600.4418")), kepler_name,
                        {"100", "60000"}, 40, 12);
}

/// Circle; ellipse of eccentricity 0.98; parabola and its neighbours on either side; hyperbola.
TEST(Kepler, OfEveryEccentricity) {
  for (const char* speed : {"1", "1/7", "sqrt(2)", "sqrt(2) - 1e-25", "sqrt(2) + 1e-25", "sqrt(2) - 1e-7", "3"})
    expect_follows_taylor(planet(2, "[1, 0]", "[0, \"" + std::string(speed) + "\"]", "1", sun("1")), kepler_name,
                          {"1/3", "20"}, 50, 12);
  // Towards the centre, at first.
  expect_follows_taylor(planet(2, "[1, 0]", "[-3, \"1/2\"]", "1", sun("1")), kepler_name, {"1/3", "5"}, 50, 12);
}

/// Nearly straight in, and out; from the far end of an ellipse of eccentricity 1 - 1e-12, and from its near end.
TEST(Kepler, OfNearlyRadialOrbits) {
  for (const char* speed : {"1e-6", "1e-10"})
    expect_follows_taylor(planet(2, "[1, 0]", "[0, \"" + std::string(speed) + "\"]", "1", sun("1")), kepler_name,
                          {"1/3", "1", "2"}, 60, 40);
  expect_follows_taylor(planet(2, "[1, 0]", "[2, \"1e-20\"]", "1", sun("1")), kepler_name, {"1/3", "20"}, 50, 12);
  expect_follows_taylor(planet(2, "[1, 0]", "[\"sqrt(2)\", \"1e-20\"]", "1", sun("1")), kepler_name, {"1/3", "20"}, 50,
                        12);
  expect_follows_taylor(planet(2, "[\"1e-6\", 0]", "[0, \"sqrt((2 - 1e-6)*1e6)\"]", "1", sun("1")), kepler_name,
                        {"1e-8", "1/10"}, 60, 30);
}

/// A charge at rest is driven away, a centre that hardly attracts leaves a straight line.
TEST(Kepler, OfRestAndOfWeakForces) {
  const std::string coulomb = "[[effect]]\nkind = \"coulomb\"\nstrength = -3\n";
  for (const char* velocity : {"[0, 0]", "[-1, 0]", "[1, 0]", "[0, \"1e-30\"]"})
    expect_follows_taylor(planet(2, "[1, 0]", velocity, "2", coulomb), kepler_name, {"1/3", "20"}, 40, 10);
  expect_follows_taylor(planet(2, "[1, 0]", "[0, 1]", "1", sun("1e-60")), kepler_name, {"1/3", "20"}, 40, 10);
}

TEST(Kepler, AttractedAndRepelledByCharges) {
  const std::string coulomb = "[[effect]]\nkind = \"coulomb\"\nstrength = ";
  expect_follows_taylor(planet(2, "[1, 0]", "[0, 1]", "2", coulomb + "3\n"), kepler_name, {"1/3", "8"}, 40, 10);
  expect_follows_taylor(planet(3, "[1, 0, 0]", "[-2, 1, 1]", "2", coulomb + "-3\n"), kepler_name, {"1/3", "8"}, 40, 10);
  // Both, as one.
  expect_follows_taylor(planet(2, "[1, 0]", "[0, 1]", "2", coulomb + "-1\n" + sun("2")), kepler_name, {"1/3", "8"}, 40,
                        10);
}

std::string pair(const std::string& first_mass, const std::string& more) {
  return "dimension = 3\n[[body]]\nname = \"a\"\nmass = " + first_mass +
         "\nposition = [1, 2, 0]\nvelocity = [0, \"1/3\", 1]\n[[body]]\nname = \"b\"\nmass = \"2/3\"\nposition = [0, "
         "0, "
         "\"1/7\"]\nvelocity = [\"1/2\", 0, 0]\n[[effect]]\nkind = \"mutual_gravity\"\nstrength = \"4/3\"\n" +
         more;
}
constexpr const char* falling = "[[effect]]\nkind = \"uniform_gravity\"\nacceleration = [\"1/3\", 0, -1]\n";

TEST(Kepler, OfTwoBodies) {
  expect_follows_taylor(pair("3", ""), kepler_name, {"1/3", "9"}, 40, 11);
  expect_follows_taylor(pair("\"1/1000\"", ""), kepler_name, {"1/3", "9"}, 40, 11);
  expect_follows_taylor(pair("3", falling), kepler_name, {"1/3", "9"}, 40, 11);
}

TEST(Kepler, NothingElseMayAct) {
  expect_unknown(planet(2, "[1, 0]", "[0, 1]", "1",
                        sun("1") + "[[effect]]\nkind = \"uniform_gravity\"\nacceleration = [\"1e-30\", 0]\n"));
  expect_unknown(planet(2, "[1, 0]", "[0, 1]", "1",
                        sun("1") + "[[effect]]\nkind = \"radial_cosine\"\ncenter = \"sun\"\nstrength = \"1e-9\"\n"));
  expect_unknown(planet(2, "[1, 0]", "[0, 1]", "1",
                        sun("1") + "[[point]]\nname = \"moon\"\nposition = [5, 0]\n[[effect]]\nkind = "
                                   "\"central_gravity\"\ncenter = \"moon\"\nstrength = \"1e-9\"\n"));
  expect_unknown(pair("3", "[[effect]]\nkind = \"uniform_gravity\"\nacceleration = [\"1/3\", 0, -1]\non = [\"a\"]\n"));
  expect_unknown(pair("3", "[[body]]\nname = \"c\"\nmass = \"1e-20\"\nposition = [5, 5, 5]\nvelocity = [0, 0, 0]\n"));
  // It falls into the centre.
  expect_unknown(planet(2, "[1, 0]", "[0, 0]", "1", sun("1")));
  expect_unknown(planet(2, "[\"3/7\", \"1/7\"]", "[3, 1]", "1", sun("1")));
}

TEST(Kepler, HasAThousandDigits) {
  expect_solves_equations(planet(2, "[\"1/2\", 0]", "[0, \"sqrt(3)\"]", "1", sun("1")), {"10", "-5/2", "1000"}, 1000);
  expect_solves_equations(planet(2, "[1, 0]", "[0, \"sqrt(2)\"]", "1", sun("1")), {"10"}, 1000);
}

/// The third law: an ellipse closes after 2 pi sqrt(a^3/mu).
TEST(Kepler, ClosesItsEllipse) {
  const PrecisionScope scope(60);
  const Assembled<Mpfr> scene =
      assemble<Mpfr>(read_scene(planet(2, "[\"1/2\", 0]", "[0, \"sqrt(3)\"]", "1", sun("1")), "ellipse"));
  const ExactPoint end = closed_form_of(scene)->at(literal<Mpfr>("200*pi"));
  // The rounding of its start changes the period, a hundred times.
  EXPECT_LE(distance(end.q, scene.q0), 10'000 * epsilon<Mpfr>());
  EXPECT_LE(distance(end.p, scene.p0), 10'000 * epsilon<Mpfr>());
}

}  // namespace
}  // namespace hbvm::core

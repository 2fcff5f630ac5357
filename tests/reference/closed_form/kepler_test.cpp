#include "reference/closed_form/against_taylor.hpp"

namespace hbvm::core {
namespace {

constexpr const char* kepler_name = "Kepler";

std::string planet(int dimension, const std::string& position, const std::string& velocity, const std::string& mass,
                   const std::string& effects, const std::string& center = "") {
  const std::string origin = center.empty() ? dimension == 2 ? "[0, 0]" : "[0, 0, 0]" : center;
  return "dimension = " + std::to_string(dimension) + "\n" + point("sun", origin, "charge = -2\n") +
         body("planet", mass, position, velocity, "charge = \"3/7\"\n") + effects;
}

std::string sun(const std::string& strength, const std::string& center = "sun") {
  return effect("central_gravity", "center = \"" + center + "\"\nstrength = \"" + strength + "\"");
}

std::string coulomb(const std::string& strength) { return effect("coulomb", "strength = " + strength); }

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
  for (const char* velocity : {"[2, \"1e-20\"]", "[\"sqrt(2)\", \"1e-20\"]"})
    expect_follows_taylor(planet(2, "[1, 0]", velocity, "1", sun("1")), kepler_name, {"1/3", "20"}, 50, 12);
  expect_follows_taylor(planet(2, "[\"1e-6\", 0]", "[0, \"sqrt((2 - 1e-6)*1e6)\"]", "1", sun("1")), kepler_name,
                        {"1e-8", "1/10"}, 60, 30);
}

/// A charge at rest is driven away, a centre that hardly attracts leaves a straight line.
TEST(Kepler, OfRestAndOfWeakForces) {
  for (const char* velocity : {"[0, 0]", "[-1, 0]", "[1, 0]", "[0, \"1e-30\"]"})
    expect_follows_taylor(planet(2, "[1, 0]", velocity, "2", coulomb("-3")), kepler_name, {"1/3", "20"}, 40, 10);
  expect_follows_taylor(planet(2, "[1, 0]", "[0, 1]", "1", sun("1e-60")), kepler_name, {"1/3", "20"}, 40, 10);
}

TEST(Kepler, AttractedAndRepelledByCharges) {
  // In the last one two forces act as one.
  for (const std::string& scene :
       {planet(2, "[1, 0]", "[0, 1]", "2", coulomb("3")), planet(3, "[1, 0, 0]", "[-2, 1, 1]", "2", coulomb("-3")),
        planet(2, "[1, 0]", "[0, 1]", "2", coulomb("-1") + sun("2"))})
    expect_follows_taylor(scene, kepler_name, {"1/3", "8"}, 40, 10);
}

std::string pair(const std::string& first_mass, const std::string& more) {
  return "dimension = 3\n" + body("a", first_mass, "[1, 2, 0]", "[0, \"1/3\", 1]") +
         body("b", "\"2/3\"", "[0, 0, \"1/7\"]", "[\"1/2\", 0, 0]") + effect("mutual_gravity", "strength = \"4/3\"") +
         more;
}

TEST(Kepler, OfTwoBodies) {
  for (const std::string& scene : {pair("3", ""), pair("\"1/1000\"", ""), pair("3", field("[\"1/3\", 0, -1]"))})
    expect_follows_taylor(scene, kepler_name, {"1/3", "9"}, 40, 11);
}

TEST(Kepler, NothingElseMayAct) {
  for (const std::string& other :
       {field("[\"1e-30\", 0]"), effect("radial_cosine", "center = \"sun\"\nstrength = \"1e-9\""),
        point("moon", "[5, 0]") + sun("1e-9", "moon")})
    expect_unknown(planet(2, "[1, 0]", "[0, 1]", "1", sun("1") + other));
  expect_unknown(pair("3", field("[\"1/3\", 0, -1]\non = [\"a\"]")));
  expect_unknown(pair("3", body("c", "\"1e-20\"", "[5, 5, 5]", "[0, 0, 0]")));
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

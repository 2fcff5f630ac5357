#include <fmt/format.h>

#include "integrate/runs.hpp"
#include "printing.hpp"
#include "reference/scene_tables.hpp"

namespace hbvm::core {
namespace {

/// All fields about a centre, the attraction by another body and a formula, on whoever is there.
const std::string about_the_sun = "center = \"sun\"\n";
const std::string fields =
    effect("central_gravity", about_the_sun + "strength = 1") +
    effect("oblateness", about_the_sun + "strength = 1\nradius = \"1/2\"\nJ2 = 0.1\naxis = [1, 2, 2]") +
    effect("trap", about_the_sun + "stiffness = \"1/10\"\nexponent = 4") +
    effect("radial_cosine", about_the_sun + "strength = \"1/3\"") + effect("mutual_gravity", "strength = \"1/20\"") +
    formula("m*x*y/10 - z^2/7");

const std::string sun_and_moon = "dimension = 3\n" + point("sun", "[\"1/10\", 0, 0]") +
                                 body("moon", "1", "[0, 2, \"1/2\"]", "[\"-1/2\", 0, \"1/5\"]");

/// A round body that does not turn moves as a mass point, by either solver.
TEST(RigidBodiesInFields, MoveAsMassPointsIfTheyDoNotTurn) {
  const PrecisionScope digits(30);
  const std::string mass_point = body("a", "2", "[\"3/2\", 0, \"1/4\"]", "[0, 1, \"-1/10\"]");
  const Scene small = read_scene(sun_and_moon + mass_point + fields, "point.toml");
  const Scene ball = read_scene(sun_and_moon + changed(mass_point, "[[body]]", "[[rigid_body]]") +
                                    "center = [0, 0, 0]\nsecond_moment = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\n"
                                    "directors = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\nangular_velocity = [0, 0, 0]\n" +
                                    fields,
                                "ball.toml");
  for (const SolverKind kind : {SolverKind::newton, SolverKind::fixed_point}) {
    SceneRun<Mpfr> one(small, 6, 3, "1/16", "1", kind), other(ball, 6, 3, "1/16", "1", kind);
    const Vector<Mpfr> expected = one({}).end.q, found = other({}).end.q;
    ASSERT_EQ(expected.size(), 6);
    for (Index i = 0; i < 6; ++i) EXPECT_LE(magnitude(Mpfr(found[i] - expected[i])), 1'000 * epsilon<Mpfr>()) << i;
  }
}

/// Two masses on a rod of length 2 r about the centre of mass: what the rigid body neglects is of the order r^2.
TEST(RigidBodiesInFields, AreOffFromADumbBellByTheSquareOfItsSize) {
  const PrecisionScope digits(30);
  const std::string sun = "dimension = 2\n" + point("sun", "[0, 0]"),
                    gravity = effect("central_gravity", about_the_sun + "strength = 1");
  const auto difference = [&](const std::string& r) {
    const std::string a = body("a", "1", fmt::format("[\"1 - 3/5*{0}\", \"-4/5*{0}\"]", r),
                               fmt::format("[\"4/5*{0}\", \"1 - 3/5*{0}\"]", r)),
                      b = body("b", "1", fmt::format("[\"1 + 3/5*{0}\", \"4/5*{0}\"]", r),
                               fmt::format("[\"-4/5*{0}\", \"1 + 3/5*{0}\"]", r)),
                      body_of_both = fmt::format(
                          "[[rigid_body]]\nname = \"bar\"\nmass = 2\nposition = [1, 0]\nvelocity = [0, 1]\n"
                          "center = [0, 0]\nsecond_moment = [[\"2*{0}^2\", 0], [0, 0]]\n"
                          "directors = [[\"3/5\", \"4/5\"], [\"-4/5\", \"3/5\"]]\nangular_velocity = 1\n",
                          r);
    const Scene two = read_scene(sun + a + b + rod("a", "b", fmt::format("\"2*{}\"", r)) + gravity, "two.toml"),
                bar = read_scene(sun + body_of_both + gravity, "bar.toml");
    SceneRun<Mpfr> one(two, 6, 3, "1/64", "1/2", SolverKind::newton),
        other(bar, 6, 3, "1/64", "1/2", SolverKind::newton);
    const Vector<Mpfr> masses = one({}).end.q, rigid = other({}).end.q;
    Mpfr greatest = 0;
    for (Index i = 0; i < 2; ++i) raise_to(greatest, magnitude(Mpfr((masses[i] + masses[i + 2]) / 2 - rigid[i])));
    return greatest;
  };
  const Mpfr coarse = difference("(1/50)"), fine = difference("(1/100)");
  EXPECT_GT(fine, literal<Mpfr>("1e-6"));
  EXPECT_LT(coarse, literal<Mpfr>("1e-3"));
  EXPECT_GT(coarse / fine, literal<Mpfr>("3.9"));
  EXPECT_LT(coarse / fine, literal<Mpfr>("4.1"));
}

}  // namespace
}  // namespace hbvm::core

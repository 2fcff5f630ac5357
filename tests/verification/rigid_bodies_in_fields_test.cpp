#include <fmt/format.h>

#include "integrate/runs.hpp"
#include "printing.hpp"
#include "scene/scene_text.hpp"

namespace hbvm::core {
namespace {

/// All fields about a centre, the attraction by another body and a formula, on whoever is there.
const std::string fields = R"(
[[effect]]
kind = "central_gravity"
center = "sun"
strength = 1
[[effect]]
kind = "oblateness"
center = "sun"
strength = 1
radius = "1/2"
J2 = 0.1
axis = [1, 2, 2]
[[effect]]
kind = "trap"
center = "sun"
stiffness = "1/10"
exponent = 4
[[effect]]
kind = "radial_cosine"
center = "sun"
strength = "1/3"
[[effect]]
kind = "mutual_gravity"
strength = "1/20"
[[effect]]
kind = "formula"
U = "m*x*y/10 - z^2/7"
)";

const std::string sun_and_moon = R"(dimension = 3
[[point]]
name = "sun"
position = ["1/10", 0, 0]
[[body]]
name = "moon"
mass = 1
position = [0, 2, "1/2"]
velocity = ["-1/2", 0, "1/5"]
)";

/// A round body that does not turn moves as a mass point, by either solver.
TEST(RigidBodiesInFields, MoveAsMassPointsIfTheyDoNotTurn) {
  const PrecisionScope digits(30);
  const std::string start = "position = [\"3/2\", 0, \"1/4\"]\nvelocity = [0, 1, \"-1/10\"]\nmass = 2\n";
  const Scene point = read_scene(sun_and_moon + "[[body]]\nname = \"a\"\n" + start + fields, "point.toml");
  const Scene ball = read_scene(sun_and_moon + "[[rigid_body]]\nname = \"a\"\n" + start +
                                    "center = [0, 0, 0]\nsecond_moment = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\n"
                                    "directors = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\nangular_velocity = [0, 0, 0]\n" +
                                    fields,
                                "ball.toml");
  for (const SolverKind kind : {SolverKind::newton, SolverKind::fixed_point}) {
    SceneRun<Mpfr> one(point, 6, 3, "1/16", "1", kind), other(ball, 6, 3, "1/16", "1", kind);
    const Vector<Mpfr> expected = one({}).end.q, found = other({}).end.q;
    ASSERT_EQ(expected.size(), 6);
    for (Index i = 0; i < 6; ++i) EXPECT_LE(magnitude(Mpfr(found[i] - expected[i])), 1'000 * epsilon<Mpfr>()) << i;
  }
}

/// Two masses on a rod of length 2 r about the centre of mass: what the rigid body neglects is of the order r^2.
TEST(RigidBodiesInFields, AreOffFromADumbBellByTheSquareOfItsSize) {
  const PrecisionScope digits(30);
  const std::string sun = "dimension = 2\n[[point]]\nname = \"sun\"\nposition = [0, 0]\n",
                    gravity = "[[effect]]\nkind = \"central_gravity\"\ncenter = \"sun\"\nstrength = 1\n";
  const auto difference = [&](const std::string& r) {
    const Scene two = read_scene(
        sun +
            fmt::format("[[body]]\nname = \"a\"\nmass = 1\nposition = [\"1 - 3/5*{0}\", \"-4/5*{0}\"]\nvelocity = "
                        "[\"4/5*{0}\", \"1 - 3/5*{0}\"]\n[[body]]\nname = \"b\"\nmass = 1\nposition = [\"1 + "
                        "3/5*{0}\", \"4/5*{0}\"]\nvelocity = [\"-4/5*{0}\", \"1 + 3/5*{0}\"]\n",
                        r) +
            rod("a", "b", fmt::format("\"2*{}\"", r)) + gravity,
        "two.toml");
    const Scene bar = read_scene(
        sun +
            fmt::format(
                "[[rigid_body]]\nname = \"bar\"\nmass = 2\nposition = [1, 0]\nvelocity = [0, 1]\ncenter = [0, 0]\n"
                "second_moment = [[\"2*{0}^2\", 0], [0, 0]]\ndirectors = [[\"3/5\", \"4/5\"], [\"-4/5\", "
                "\"3/5\"]]\nangular_velocity = 1\n",
                r) +
            gravity,
        "bar.toml");
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

#include "scene/effect_reach.hpp"

#include "printing.hpp"
#include "problem/momenta.hpp"
#include "problem/point.hpp"
#include "scene/assemble.hpp"
#include "scene/scene_text.hpp"

namespace hbvm::core {
namespace {

/// A centre, a body, a free rigid body and one that turns about a point of space.
const std::string sky = R"(dimension = 3
[[point]]
name = "sun"
position = ["1/10", 0, 1]
[[body]]
name = "probe"
mass = 2
position = [4, 0, 0]
velocity = [0, 1, 0]
[[rigid_body]]
name = "ship"
position = [0, 5, 0]
velocity = [1, 0, 0]
mass = 3
center = ["1/2", "-1/3", "1/4"]
second_moment = [[2, -0.5, 0.375], [-0.5, 3, -0.25], [0.375, -0.25, 2]]
directors = [["2/3", "2/3", "1/3"], ["-2/3", "1/3", "2/3"], ["1/3", "-2/3", "2/3"]]
angular_velocity = [1, 2, "1/2"]
[[rigid_body]]
name = "top"
fixed_at = [0, -6, 0]
mass = 5
center = [0, 0, "1/2"]
second_moment = [[2, 0, 0], [0, 2, 0], [0, 0, 3]]
directors = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
angular_velocity = [0, 0, 1]
[[attachment]]
name = "heart"
of = "ship"
at = ["1/2", "-1/3", "1/4"]
[[attachment]]
name = "crown"
of = "top"
at = [0, 0, "1/2"]
)";

std::string effect(const std::string& keys) { return "[[effect]]\n" + keys + "\n"; }

std::vector<EffectReach> reach(const std::string& text) {
  return assemble<double>(read_scene(text, "test.toml")).reach;
}

std::string refused(const std::string& text) {
  try {
    reach(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

/// An effect without `on` or `between`, and what it must be. The points where rigid bodies have their centres of mass,
/// and their masses, stand as numbers.
struct SameEffect {
  const char *name, *on_all, *by_points;
};
void PrintTo(const SameEffect& same, std::ostream* out) { *out << same.name; }

std::string name_of_same_effect(const ::testing::TestParamInfo<SameEffect>& same) { return same.param.name; }

class EffectOnAll : public ::testing::TestWithParam<SameEffect> {};

TEST_P(EffectOnAll, ActsOnRigidBodiesAtTheirCentresOfMass) {
  const PrecisionScope digits(50);
  const auto scene_of = [](const std::string& text) { return assemble<Mpfr>(read_scene(text, "test.toml")); };
  const Assembled<Mpfr> all = scene_of(sky + GetParam().on_all), points = scene_of(sky + GetParam().by_points);
  ASSERT_EQ(all.problem.m(), points.problem.m());
  Vector<Mpfr> q(all.q0.size()), v(all.q0.size());
  for (Index i = 0; i < q.size(); ++i) {
    q[i] = all.q0[i] + Mpfr((7 * i * i + 5 * i) % 23 - 11) / 70;
    v[i] = Mpfr((3 * i * i + 11 * i) % 19 - 9) / 7;
  }
  const Vector<Mpfr> zero = Vector<Mpfr>::Zero(q.size());
  Point<Mpfr> at(all.problem), other(points.problem);
  const auto near = [](const Mpfr& a, const Mpfr& b) { return magnitude(Mpfr(a - b)) <= 1'000 * epsilon<Mpfr>(); };
  EXPECT_PRED2(near, at.energy(q, zero), other.energy(q, zero));
  const Vector<Mpfr> force = at.forces(q, zero).applied, expected = other.forces(q, zero).applied;
  for (Index i = 0; i < q.size(); ++i) EXPECT_PRED2(near, force[i], expected[i]) << i;
  const Mpfr step = literal<Mpfr>("1e-16");
  const Mpfr slope =
      (at.energy(Vector<Mpfr>(q - step * v), zero) - at.energy(Vector<Mpfr>(q + step * v), zero)) / (2 * step);
  EXPECT_LE(magnitude(Mpfr(force.dot(v) - slope)), literal<Mpfr>("1e-26"));
  const auto names = [](const Problem<Mpfr>& problem) {
    std::string text;
    for (const auto& component : conserved_momenta(problem)) text += component.name() + " ";
    return text;
  };
  EXPECT_EQ(names(all.problem), names(points.problem));
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, EffectOnAll,
    ::testing::Values(
        SameEffect{"CentralGravity", "[[effect]]\nkind = \"central_gravity\"\ncenter = \"sun\"\nstrength = 7\n",
                   "[[effect]]\nkind = \"formula\"\ncenter = \"sun\"\non = [\"probe\"]\nU = \"14/r\"\n"
                   "[[effect]]\nkind = \"formula\"\ncenter = \"sun\"\non = [\"heart\"]\nU = \"21/r\"\n"
                   "[[effect]]\nkind = \"formula\"\ncenter = \"sun\"\non = [\"crown\"]\nU = \"35/r\"\n"},
        SameEffect{"MutualGravity", "[[effect]]\nkind = \"mutual_gravity\"\nstrength = 7\n",
                   "[[effect]]\nkind = \"formula\"\nbetween = [\"probe\", \"heart\"]\nU = \"42/r\"\n"
                   "[[effect]]\nkind = \"formula\"\nbetween = [\"heart\", \"crown\"]\nU = \"105/r\"\n"
                   "[[effect]]\nkind = \"formula\"\nbetween = [\"probe\", \"crown\"]\nU = \"70/r\"\n"},
        SameEffect{"Trap", "[[effect]]\nkind = \"trap\"\ncenter = \"sun\"\nstiffness = \"1/20\"\nexponent = 4\n",
                   "[[effect]]\nkind = \"trap\"\ncenter = \"sun\"\nstiffness = \"1/20\"\nexponent = 4\n"
                   "on = [\"probe\", \"heart\", \"crown\"]\n"},
        SameEffect{"RadialCosine", "[[effect]]\nkind = \"radial_cosine\"\ncenter = \"sun\"\nstrength = 7\n",
                   "[[effect]]\nkind = \"radial_cosine\"\ncenter = \"sun\"\nstrength = 7\n"
                   "on = [\"probe\", \"heart\", \"crown\"]\n"},
        SameEffect{"Oblateness",
                   "[[effect]]\nkind = \"oblateness\"\ncenter = \"sun\"\nstrength = 7\nradius = 2\nJ2 = 0.1\n"
                   "axis = [0, 0, 1]\n",
                   "[[effect]]\nkind = \"formula\"\ncenter = \"sun\"\non = [\"probe\"]\n"
                   "U = \"-7*2*0.1*4*(3*z^2/r^2 - 1)/(2*r^3)\"\n"
                   "[[effect]]\nkind = \"formula\"\ncenter = \"sun\"\non = [\"heart\"]\n"
                   "U = \"-7*3*0.1*4*(3*z^2/r^2 - 1)/(2*r^3)\"\n"
                   "[[effect]]\nkind = \"formula\"\ncenter = \"sun\"\non = [\"crown\"]\n"
                   "U = \"-7*5*0.1*4*(3*z^2/r^2 - 1)/(2*r^3)\"\n"},
        SameEffect{"Spring", "[[effect]]\nkind = \"spring\"\nstiffness = 2\nrest_length = 1\n",
                   "[[effect]]\nkind = \"spring\"\nstiffness = 2\nrest_length = 1\n"
                   "between = [[\"probe\", \"heart\"], [\"probe\", \"crown\"], [\"heart\", \"crown\"]]\n"},
        SameEffect{"LennardJones", "[[effect]]\nkind = \"lennard_jones\"\ndepth = 2\ndiameter = 4\n",
                   "[[effect]]\nkind = \"lennard_jones\"\ndepth = 2\ndiameter = 4\n"
                   "between = [[\"probe\", \"heart\"], [\"probe\", \"crown\"], [\"heart\", \"crown\"]]\n"},
        SameEffect{"FormulaOnEach", "[[effect]]\nkind = \"formula\"\nU = \"m*x*y - z^3/9\"\n",
                   "[[effect]]\nkind = \"formula\"\nof = [\"probe\"]\nU = \"2*x1*y1 - z1^3/9\"\n"
                   "[[effect]]\nkind = \"formula\"\nof = [\"heart\"]\nU = \"3*x1*y1 - z1^3/9\"\n"
                   "[[effect]]\nkind = \"formula\"\nof = [\"crown\"]\nU = \"5*x1*y1 - z1^3/9\"\n"},
        SameEffect{"FormulaAboutACentre", "[[effect]]\nkind = \"formula\"\ncenter = \"sun\"\nU = \"m*x/r\"\n",
                   "[[effect]]\nkind = \"formula\"\ncenter = \"sun\"\non = [\"probe\"]\nU = \"2*x/r\"\n"
                   "[[effect]]\nkind = \"formula\"\ncenter = \"sun\"\non = [\"heart\"]\nU = \"3*x/r\"\n"
                   "[[effect]]\nkind = \"formula\"\ncenter = \"sun\"\non = [\"crown\"]\nU = \"5*x/r\"\n"},
        SameEffect{"FormulaOfPairs",
                   "[[effect]]\nkind = \"formula\"\nbetween = [[\"ship\", \"sun\"]]\nU = \"x1*m1/r\"\n",
                   "[[effect]]\nkind = \"formula\"\nbetween = [[\"heart\", \"sun\"]]\nU = \"x1*3/r\"\n"},
        SameEffect{"FormulaOfAGroup",
                   "[[effect]]\nkind = \"formula\"\nof = [\"probe\", \"ship\"]\nU = \"probe.x*ship.y*ship.m\"\n",
                   "[[effect]]\nkind = \"formula\"\nof = [\"probe\", \"heart\"]\nU = \"probe.x*heart.y*3\"\n"}),
    name_of_same_effect);

TEST(EffectReach, NamesBodiesPairsAndGroups) {
  const auto found = reach(sky + effect("kind = \"central_gravity\"\ncenter = \"sun\"\nstrength = 1") +
                           effect("kind = \"mutual_gravity\"\nstrength = 1\nbetween = [\"ship\", \"probe\"]") +
                           effect("kind = \"formula\"\nof = [\"probe\", \"crown\"]\nU = \"x1*x2\""));
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(to_text(found[0]), "'probe', 'ship', 'top'");
  EXPECT_EQ(to_text(found[1]), "'ship'-'probe'");
  EXPECT_EQ(to_text(found[2]), "'probe'-'crown'");
}

TEST(EffectReach, OfManyIsNotListedToTheEnd) {
  EffectReach many;
  for (int i = 0; i < 25; ++i) many.on.push_back({std::to_string(i)});
  const std::string text = to_text(many);
  EXPECT_TRUE(text.starts_with("'0', '1'")) << text;
  EXPECT_TRUE(text.ends_with("'19', and 5 more")) << text;
}

TEST(EffectReach, SaysWhoIsLeftOut) {
  std::string text = sky + effect("kind = \"trap\"\ncenter = \"sun\"\nstiffness = 1\nexponent = 2\non = [\"crown\"]") +
                     effect("kind = \"central_gravity\"\ncenter = \"sun\"\nstrength = 1");
  text = changed(text, "center = [0, 0, \"1/2\"]", "center = [0, 0, 0]");
  const Scene scene = read_scene(text, "test.toml");
  const auto found = assemble<double>(scene).reach;
  using Left = std::vector<std::pair<std::string, std::string>>;
  EXPECT_EQ(left_out(scene, scene.effects[0], found[0]), (Left{{"probe", "not named"}, {"ship", "not named"}}));
  EXPECT_EQ(left_out(scene, scene.effects[1], found[1]), (Left{{"top", "its centre of mass is fixed in space"}}));
}

TEST(EffectReach, OfNobodyIsRefusedByLine) {
  const std::string alone =
      "dimension = 2\n[[point]]\nname = \"o\"\nposition = [0, 0]\n[[body]]\nname = \"a\"\nmass = 1\n"
      "position = [1, 0]\nvelocity = [0, 0]\n";
  const auto expect = [&](const std::string& keys, const std::vector<std::string>& words) {
    const std::string message = refused(alone + effect(keys));
    EXPECT_TRUE(message.starts_with("test.toml:10: effect 1 (")) << message;
    for (const std::string& word : words) EXPECT_NE(message.find(word), std::string::npos) << message;
  };
  expect("kind = \"mutual_gravity\"\nstrength = 1", {"acts on nobody", "'a' (there is none to pair it with)"});
  expect("kind = \"coulomb\"\nstrength = 1", {"acts on nobody", "'a' (no charge)"});
  expect("kind = \"uniform_gravity\"\nacceleration = [0, -1]\non = []", {"acts on nobody", "'a' (not named)"});
  expect("kind = \"formula\"\non = []\nU = \"x\"", {"acts on nobody", "'a' (not named)"});
  const std::string top =
      "dimension = 2\n[[point]]\nname = \"o\"\nposition = [3, 0]\n[[rigid_body]]\nname = \"top\"\n"
      "fixed_at = [0, 0]\nmass = 1\ncenter = [0, 0]\nsecond_moment = [[1, 0], [0, 1]]\n"
      "directors = [[1, 0], [0, 1]]\nangular_velocity = 1\n";
  EXPECT_NE(refused(top + effect("kind = \"central_gravity\"\ncenter = \"o\"\nstrength = 1"))
                .find("acts on nobody: not on 'top' (its centre of mass is fixed in space)"),
            std::string::npos);
  EXPECT_NE(refused(top + effect("kind = \"central_gravity\"\ncenter = \"o\"\nstrength = 1\non = [\"top\"]"))
                .find("'top' is fixed in space, by its centre of mass"),
            std::string::npos);
  EXPECT_EQ(refused(top + effect("kind = \"uniform_gravity\"\nacceleration = [0, -1]")), "") << "it has energy there";
}

TEST(EffectReach, ARigidBodyHasNoChargeOfItsOwn) {
  const std::string message =
      refused(sky + effect("kind = \"coulomb\"\nstrength = 1\nbetween = [\"ship\", \"probe\"]"));
  EXPECT_NE(message.find("'ship' has no charge; give one to a point of it"), std::string::npos) << message;
}

TEST(EffectReach, AForceWithinARigidBodyIsRefused) {
  const std::string message =
      refused(sky + effect("kind = \"spring\"\nstiffness = 1\nbetween = [\"ship\", \"heart\"]"));
  EXPECT_NE(message.find("both ends are points of the rigid body 'ship'"), std::string::npos) << message;
}

}  // namespace
}  // namespace hbvm::core

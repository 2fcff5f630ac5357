#include "scene/effect_reach.hpp"

#include "scene/assembled.hpp"

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

/// An effect without `on` or `between`, and what it must be. The points where rigid bodies have their centres of mass,
/// and their masses, stand as numbers.
struct SameEffect {
  std::string on_all, by_points;
};

void expect_same(const SameEffect& same) {
  const Assembled<Mpfr> all = assembled<Mpfr>(sky + same.on_all), points = assembled<Mpfr>(sky + same.by_points);
  ASSERT_EQ(all.problem.m(), points.problem.m());
  const Vector<Mpfr> q = away_from(all.q0, 70);
  const Vector<Mpfr> zero = Vector<Mpfr>::Zero(q.size());
  StateEvaluator<Mpfr> at(all.problem), other(points.problem);
  const auto near = [](const Mpfr& a, const Mpfr& b) { return magnitude(Mpfr(a - b)) <= 1'000 * epsilon<Mpfr>(); };
  EXPECT_PRED2(near, at.energy(q, zero), other.energy(q, zero));
  const Vector<Mpfr> force = at.forces(q, zero).applied, expected = other.forces(q, zero).applied;
  for (Index i = 0; i < q.size(); ++i) EXPECT_PRED2(near, force[i], expected[i]) << i;
  expect_forces_are_derivatives(all.problem, q);
  EXPECT_EQ(conserved(all.problem), conserved(points.problem));
}

TEST(EffectOnAll, ActsOnRigidBodiesAtTheirCentresOfMass) {
  const PrecisionScope digits(50);
  const std::string each = "on = [\"probe\", \"heart\", \"crown\"]";
  const std::string pairs = "between = [[\"probe\", \"heart\"], [\"probe\", \"crown\"], [\"heart\", \"crown\"]]";
  const std::string trap = "kind = \"trap\"\ncenter = \"sun\"\nstiffness = \"1/20\"\nexponent = 4\n";
  const std::string cosine = "kind = \"radial_cosine\"\ncenter = \"sun\"\nstrength = 7\n";
  const std::string spring = "kind = \"spring\"\nstiffness = 2\nrest_length = 1\n";
  const std::string lennard_jones = "kind = \"lennard_jones\"\ndepth = 2\ndiameter = 4\n";
  const auto formula = [](const std::string& on, const std::string& U) {
    return effect("kind = \"formula\"\n" + on + "\nU = \"" + U + "\"");
  };
  const auto about = [&](const std::string& point, const std::string& U) {
    return formula("center = \"sun\"\non = [\"" + point + "\"]", U);
  };
  const auto between = [&](const std::string& a, const std::string& b, const std::string& U) {
    return formula("between = [\"" + a + "\", \"" + b + "\"]", U);
  };
  const SameEffect same[] = {
      {effect("kind = \"central_gravity\"\ncenter = \"sun\"\nstrength = 7"),
       about("probe", "14/r") + about("heart", "21/r") + about("crown", "35/r")},
      {effect("kind = \"mutual_gravity\"\nstrength = 7"),
       between("probe", "heart", "42/r") + between("heart", "crown", "105/r") + between("probe", "crown", "70/r")},
      {effect(trap), effect(trap + each)},
      {effect(cosine), effect(cosine + each)},
      {effect("kind = \"oblateness\"\ncenter = \"sun\"\nstrength = 7\nradius = 2\nJ2 = 0.1\naxis = [0, 0, 1]"),
       about("probe", "-7*2*0.1*4*(3*z^2/r^2 - 1)/(2*r^3)") + about("heart", "-7*3*0.1*4*(3*z^2/r^2 - 1)/(2*r^3)") +
           about("crown", "-7*5*0.1*4*(3*z^2/r^2 - 1)/(2*r^3)")},
      {effect(spring), effect(spring + pairs)},
      {effect(lennard_jones), effect(lennard_jones + pairs)},
      {formula("", "m*x*y - z^3/9"), formula("of = [\"probe\"]", "2*x1*y1 - z1^3/9") +
                                         formula("of = [\"heart\"]", "3*x1*y1 - z1^3/9") +
                                         formula("of = [\"crown\"]", "5*x1*y1 - z1^3/9")},
      {formula("center = \"sun\"", "m*x/r"),
       about("probe", "2*x/r") + about("heart", "3*x/r") + about("crown", "5*x/r")},
      {between("ship", "sun", "x1*m1/r"), between("heart", "sun", "x1*3/r")},
      {formula("of = [\"probe\", \"ship\"]", "probe.x*ship.y*ship.m"),
       formula("of = [\"probe\", \"heart\"]", "probe.x*heart.y*3")}};
  for (const SameEffect& effects : same) {
    SCOPED_TRACE(effects.on_all);
    expect_same(effects);
  }
}

TEST(EffectReach, NamesBodiesPairsAndGroups) {
  const auto found =
      assembled<double>(sky + effect("kind = \"central_gravity\"\ncenter = \"sun\"\nstrength = 1") +
                        effect("kind = \"mutual_gravity\"\nstrength = 1\nbetween = [\"ship\", \"probe\"]") +
                        effect("kind = \"formula\"\nof = [\"probe\", \"crown\"]\nU = \"x1*x2\""))
          .reach;
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
  for (const auto& [keys, who] :
       {std::pair("kind = \"mutual_gravity\"\nstrength = 1", "'a' (there is none to pair it with)"),
        {"kind = \"coulomb\"\nstrength = 1", "'a' (no charge)"},
        {"kind = \"uniform_gravity\"\nacceleration = [0, -1]\non = []", "'a' (not named)"},
        {"kind = \"formula\"\non = []\nU = \"x\"", "'a' (not named)"}}) {
    const std::string message = inconsistency<double>(alone + effect(keys));
    EXPECT_TRUE(message.starts_with("test.toml:10: effect 1 (")) << message;
    expect_words(message, {"acts on nobody", who});
  }
  const std::string top =
      "dimension = 2\n[[point]]\nname = \"o\"\nposition = [3, 0]\n[[rigid_body]]\nname = \"top\"\n"
      "fixed_at = [0, 0]\nmass = 1\ncenter = [0, 0]\nsecond_moment = [[1, 0], [0, 1]]\n"
      "directors = [[1, 0], [0, 1]]\nangular_velocity = 1\n";
  const std::string central = "kind = \"central_gravity\"\ncenter = \"o\"\nstrength = 1";
  expect_words(inconsistency<double>(top + effect(central)),
               {"acts on nobody: not on 'top' (its centre of mass is fixed in space)"});
  expect_words(inconsistency<double>(top + effect(central + "\non = [\"top\"]")),
               {"'top' is fixed in space, by its centre of mass"});
  EXPECT_EQ(inconsistency<double>(top + effect("kind = \"uniform_gravity\"\nacceleration = [0, -1]")), "")
      << "it has energy there";
}

TEST(EffectReach, ARigidBodyHasNoChargeOfItsOwn) {
  expect_words(inconsistency<double>(sky + effect("kind = \"coulomb\"\nstrength = 1\nbetween = [\"ship\", \"probe\"]")),
               {"'ship' has no charge; give one to a point of it"});
}

TEST(EffectReach, AForceWithinARigidBodyIsRefused) {
  expect_words(inconsistency<double>(sky + effect("kind = \"spring\"\nstiffness = 1\nbetween = [\"ship\", \"heart\"]")),
               {"both ends are points of the rigid body 'ship'"});
}

}  // namespace
}  // namespace hbvm::core

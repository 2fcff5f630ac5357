#include "scene/assembled.hpp"
#include "scene/joined_bodies.hpp"
#include "scene/mechanism.hpp"

namespace hbvm::core {
namespace {

/// Two scenes are one if state, mass, energy, constraints and multipliers agree to the last digit, away from the start
/// as well.
void expect_same(const Assembled<Mpfr>& a, const Assembled<Mpfr>& b) {
  EXPECT_EQ(a.q0, b.q0);
  EXPECT_EQ(a.p0, b.p0);
  const auto &x = a.problem, &y = b.problem;
  EXPECT_EQ(x.dimension, y.dimension);
  ASSERT_EQ(x.m(), y.m());
  ASSERT_EQ(x.nu(), y.nu());
  EXPECT_EQ(x.mass.momentum(away_from(a.q0)), y.mass.momentum(away_from(a.q0)));
  for (std::size_t g = 0; g < x.constraints.size(); ++g) EXPECT_EQ(x.constraints[g].name, y.constraints[g].name);
  ASSERT_EQ(x.potential.terms.size(), y.potential.terms.size());
  for (std::size_t t = 0; t < x.potential.terms.size(); ++t) {
    EXPECT_EQ(x.potential.terms[t].kind, y.potential.terms[t].kind);
    EXPECT_EQ(x.potential.terms[t].displacements.size(), y.potential.terms[t].displacements.size());
  }
  StateEvaluator<Mpfr> one(x), other(y);
  for (const auto& [q, p] : {std::pair(a.q0, a.p0), std::pair(away_from(a.q0), away_from(a.p0))}) {
    EXPECT_EQ(one.energy(q, p), other.energy(q, p));
    EXPECT_EQ(one.constraints(q), other.constraints(q));
    EXPECT_EQ(one.hidden_constraints(q, p), other.hidden_constraints(q, p));
    EXPECT_EQ(one.multiplier(q, p), other.multiplier(q, p));
  }
}

void expect_round_trip(const Scene& scene) {
  SCOPED_TRACE(scene.name);
  const PrecisionScope digits(60);
  const Scene read = read_scene(write_scene(scene), scene.name);
  EXPECT_EQ(read.title, scene.title);
  EXPECT_EQ(read.source, scene.source);
  EXPECT_EQ(read.observables, scene.observables);
  EXPECT_EQ(read.constants.size(), scene.constants.size());
  ASSERT_EQ(read.points.size(), scene.points.size());
  for (std::size_t i = 0; i < read.points.size(); ++i) EXPECT_EQ(read.points[i].name, scene.points[i].name);
  ASSERT_EQ(read.bodies.size(), scene.bodies.size());
  for (std::size_t i = 0; i < read.bodies.size(); ++i) EXPECT_EQ(read.bodies[i].name, scene.bodies[i].name);
  expect_same(assemble<Mpfr>(scene), assemble<Mpfr>(read));
  EXPECT_EQ(write_scene(read), write_scene(scene));
}

TEST(WriteScene, OfAMechanismReadsBack) { expect_round_trip(read_scene(mechanism, "mechanism.toml")); }

TEST(WriteScene, OfEverySceneThatIsShippedReadsBack) {
  for (const auto& [name, text] : built_in_scenes()) expect_round_trip(read_scene(text, name));
}

TEST(WriteScene, OfEveryKeyReadsBack) { expect_round_trip(read_scene(every_key, "every_key")); }

TEST(WriteScene, OfJoinedBodiesReadsBack) {
  const Scene scene = read_scene(joined_bodies, "joined");
  expect_round_trip(scene);
  const Scene read = read_scene(write_scene(scene), "joined");
  ASSERT_EQ(read.attachments.size(), scene.attachments.size());
  for (std::size_t i = 0; i < read.attachments.size(); ++i) {
    EXPECT_EQ(read.attachments[i].name, scene.attachments[i].name);
    EXPECT_EQ(read.attachments[i].of, scene.attachments[i].of);
    EXPECT_EQ(read.attachments[i].charge.has_value(), scene.attachments[i].charge.has_value());
  }
}

TEST(WriteScene, KeepsObservables) {
  expect_round_trip(read_scene(
      changed(every_key, "[constants]", "observables = [\"angular_momentum\", \"energy\"]\n[constants]"), "observed"));
}

TEST(WriteScene, KeepsAnEffectThatActsOnNothing) {
  const Scene scene = read_scene(changed(every_key, "on = [\"a\", \"c\"]", "on = []"), "none");
  ASSERT_TRUE(scene.effects[1].on);
  const Scene again = read_scene(write_scene(scene), "none");
  ASSERT_TRUE(again.effects[1].on) << "nobody is not everybody";
  EXPECT_TRUE(again.effects[1].on->empty());
}

TEST(WriteScene, KeepsNumbersAsTheyWereWritten) {
  const std::string text = write_scene(read_scene(every_key, "every_key"));
  expect_words(text, {"\"2*L\"", "\"1.08e-3\"", "\"-1/7\"", "\"9/10\""});
}

/// Every character that TOML allows in a string, in a title and in names.
TEST(WriteScene, EscapesStrings) {
  Scene scene = read_scene(every_key, "every_key");
  std::string all = "\"quoted\" \\ back \\n \u00e9\U0001F9ED\uFEFF";
  for (char c = 0; c < ' '; ++c) all += c;
  all += '\x7f';
  scene.title = all;
  scene.source = "\ttab\r\nend\n";
  expect_round_trip(scene);
  Scene named = read_scene(changed(every_key, "name = \"pivot\"",
                                   "name = \"charge 2\""
                                   "\nposition = [7, 7, 7]\n\n[[point]]\nname = \"pivot\""),
                           "named");
  named.points[0].name = all;
  expect_round_trip(named);
}

}  // namespace
}  // namespace hbvm::core

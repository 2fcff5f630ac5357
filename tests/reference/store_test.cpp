#include "reference/store.hpp"

#include "hbvm/error.hpp"
#include "printing.hpp"
#include "problem/momenta.hpp"
#include "problem/state_evaluator.hpp"
#include "scalar/literal.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {
namespace {

StoredReference example() {
  StoredReference stored;
  Reference& r = stored.reference;
  r.scene = "a \"quoted\" \\ scene";
  r.scene_hash = "0123456789abcdef";
  r.digits = 20;
  r.digits_lost = 1.5;
  r.momentum_names = {"L_z"};
  r.routes = {{"taylor", "order 40", 0.5}, {"hbvm", "HBVM(20,20)", 1.25}};
  r.times = {{"1/3", {"0.1", "-2.5e-30"}, {"1", "0"}, {"3.25"}, "-0.5", {"7"}, 25},
             {"2", {"0.2", "-2"}, {"1.5", "0"}, {"3"}, "-0.5", {"7"}, 24}};
  stored.version = "1.2.3";
  stored.date = "2026-01-02";
  return stored;
}

TEST(Store, ReadsWhatItWrote) {
  const StoredReference stored = example(), read = read_reference(to_toml(stored), "file");
  EXPECT_EQ(to_toml(read), to_toml(stored));
  EXPECT_EQ(read.reference.scene, stored.reference.scene);
  EXPECT_TRUE(differences(stored.reference, read.reference).empty());
}

/// That digits are proved is kept, with the radius of each vector.
TEST(Store, KeepsWhatIsProved) {
  StoredReference stored = example();
  EXPECT_EQ(read_reference(to_toml(stored), "file").reference.proved, 0);
  stored.reference.proved = 20;
  stored.reference.times[1].radius = {"1e-24", "2.5e-25", "0", "3e-26"};
  const Reference read = read_reference(to_toml(stored), "file").reference;
  EXPECT_EQ(read.proved, 20);
  EXPECT_FALSE(read.times[0].radius.has_value());
  ASSERT_TRUE(read.times[1].radius.has_value());
  EXPECT_EQ(read.times[1].radius->p, "2.5e-25");
  EXPECT_EQ(read.times[1].radius->H, "3e-26");
  std::string text = to_toml(stored);
  text.replace(text.find("\"3e-26\""), 7, "\"x\"");
  EXPECT_THROW(read_reference(text, "file"), InputError);
}

/// What is shipped as proved has a radius at each time, as a proof found it.
TEST(Store, ShipsProofs) {
  int proved = 0;
  for (const auto& [name, text] : shipped_references()) {
    const Reference r = read_reference(text, name).reference;
    if (r.proved == 0) continue;
    ++proved;
    EXPECT_EQ(r.proved, r.digits) << name;
    EXPECT_EQ(r.routes.back().name, "proof") << name;
    for (const ReferenceState& state : r.times) ASSERT_TRUE(state.radius.has_value()) << name;
  }
  EXPECT_GE(proved, 25);
}

/// One digit anywhere is found, and named with its time.
TEST(Store, FindsEveryDigitThatChanged) {
  const Reference stored = example().reference;
  const auto expect = [&](const char* t, const char* what, const auto& change) {
    Reference other = stored;
    change(other);
    const std::vector<Difference> found = differences(stored, other);
    ASSERT_EQ(found.size(), 1u) << what;
    EXPECT_EQ(found[0].t, t);
    EXPECT_EQ(found[0].what, what);
    EXPECT_NE(found[0].stored, found[0].found);
    EXPECT_EQ(differences(other, stored).size(), 1u) << what;
  };
  expect("1/3", "q_2", [](Reference& r) { r.times[0].q[1] = "-2.6e-30"; });
  expect("2", "p_1", [](Reference& r) { r.times[1].p[0] = "1.6"; });
  expect("2", "lambda_1", [](Reference& r) { r.times[1].lambda[0] = "3.1"; });
  expect("1/3", "H", [](Reference& r) { r.times[0].H = "0.5"; });
  expect("1/3", "momentum_1", [](Reference& r) { r.times[0].momenta[0] = "8"; });
  expect("2", "q_2", [](Reference& r) { r.times[1].q.pop_back(); });
}

TEST(Store, RefusesWhatIsNone) {
  const std::string good = to_toml(example());
  const auto broken = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return text;
  };
  for (const std::string& bad :
       {std::string("nonsense"), std::string(), broken("format 1", "format 9"), broken("\"0.1\"", "\"0.1x\""),
        broken("\"0.1\"", "0.1"), broken("digits = 20", "digits = \"many\""), broken("H = ", "h = "),
        broken("\"-2.5e-30\"", "\"-2.5e\""), broken("\"0.1\",", ""), broken("scene_hash", "hash")})
    EXPECT_THROW(read_reference(bad, "file"), InputError) << bad;
}

/// By what the scene says and by the value of the time.
TEST(Store, FindsAReference) {
  Scene scene = load_scene("tethered_satellites");
  const auto digits_at = [&](const char* t, int digits) {
    const std::optional<FoundReference> found = find_reference(scene, Expression::parse(t), digits);
    return found ? found->digits : 0;
  };
  EXPECT_EQ(digits_at("10", 1), 100);
  EXPECT_EQ(digits_at("10", 100), 100);
  EXPECT_EQ(digits_at("10", 101), 0);
  EXPECT_EQ(digits_at("100", 30), 50);
  EXPECT_EQ(digits_at("1000", 20), 20);
  EXPECT_EQ(digits_at("1000", 21), 0);
  EXPECT_EQ(digits_at("2*5.000 + sqrt(2)*0", 1), 100);
  EXPECT_EQ(digits_at("10 + 1e-90", 1), 0);
  EXPECT_EQ(digits_at("11", 1), 0);
  scene.name = scene.title = "of another name";
  EXPECT_EQ(digits_at("10", 1), 100);
  const std::optional<FoundReference> found = find_reference(scene, Expression::parse("1e2"), 1);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->name, "tethered_satellites_t100_50");
  EXPECT_EQ(found->state.t, "100");
  scene.bodies.front().mass = Expression::parse("1 + 1e-40");
  EXPECT_EQ(digits_at("10", 1), 0);
}

/// Two routes agreed on everything that is shipped.
TEST(Store, ShipsReferencesThatCanBeRead) {
  for (const auto& [name, text] : shipped_references()) {
    const StoredReference stored = read_reference(text, name);
    EXPECT_GE(stored.reference.routes.size(), 2u) << name;
    EXPECT_EQ(scene_hash(load_scene(stored.reference.scene)), stored.reference.scene_hash) << name;
    for (const ReferenceState& state : stored.reference.times) EXPECT_GT(state.agreed, stored.reference.digits) << name;
  }
}

/// What is conserved is what it was at the start, to the last digit that is printed, and what the printed state has.
TEST(Store, ShipsWhatIsConserved) {
  for (const auto& shipped : shipped_references()) {
    const std::string& name = shipped.first;
    const Reference reference = read_reference(shipped.second, name).reference;
    const PrecisionScope scope(static_cast<unsigned>(reference.digits) + 20);
    const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene(reference.scene));
    StateEvaluator<Mpfr> point(scene.problem);
    const auto momenta = conserved_momenta(scene.problem);
    const Mpfr unit = literal<Mpfr>("1e-" + std::to_string(reference.digits));
    for (const ReferenceState& state : reference.times) {
      const auto expect = [&](const std::string& what, const std::string& printed, const Mpfr& value,
                              const Mpfr& size) {
        const Mpfr number = literal<Mpfr>(printed), scale = number == 0 ? size : magnitude(value);
        EXPECT_LE(magnitude(Mpfr(number - value)), unit * scale) << what << " of " << name << " is " << printed;
      };
      if (scene.problem.driven.empty())
        expect("H", state.H, point.energy(scene.q0, scene.p0), point.energy_size(scene.q0, scene.p0));
      ASSERT_EQ(state.momenta.size(), momenta.size()) << name;
      for (std::size_t i = 0; i < momenta.size(); ++i) {
        const MomentumValue<Mpfr> start = momentum(scene.problem, momenta[i], scene.q0, scene.p0);
        expect(momenta[i].name(), state.momenta[i], start.value, start.size);
      }
    }
  }
}

}  // namespace
}  // namespace hbvm::core

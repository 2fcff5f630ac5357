#include "run/start_state.hpp"

#include "printing.hpp"
#include "scalar/literal.hpp"
#include "scene/scene_text.hpp"

namespace hbvm::core {
namespace {

template <class S>
class StartStateTest : public InDigits<50> {
 protected:
  const Scene text = load_scene("simple_pendulum");
  const Assembled<S> scene = assemble<S>(text);

  State<S> state(const std::string& json) const { return evaluate<S>(read_start_state(json, "a.json"), text, scene); }
  /// What it is refused with; empty if it is not.
  std::string start_refusal(const std::string& json) const {
    return refused([&] { state(json); });
  }
};
TYPED_TEST_SUITE(StartStateTest, AllScalars, ScalarNames);

TYPED_TEST(StartStateTest, HasAllDigitsOfItsText) {
  using S = TypeParam;
  const State<S> state = this->state(R"x({"q": ["3/5", "-0.8"], "p": ["0.1", "sqrt(2)"],
      "q_carry": ["1e-60", "0"], "p_carry": ["0", "-1/3"], "x": 1})x");
  EXPECT_EQ(state.q[0], S(3) / 5);
  EXPECT_EQ(state.q[1], literal<S>("-0.8"));
  EXPECT_EQ(state.p[0], literal<S>("0.1"));
  EXPECT_LE(magnitude(S(state.p[1] * state.p[1] - 2)), 8 * epsilon<S>());
  EXPECT_EQ(state.q_carry[0], literal<S>("1e-60"));
  EXPECT_EQ(state.p_carry[1], S(-1) / 3);
  const State<S> without = this->state(R"({"q": ["0", "-1"], "p": ["0", "0"]})");
  EXPECT_EQ(max_norm(without.q_carry), 0);
  EXPECT_EQ(max_norm(without.p_carry), 0);
}

/// What a long run may gather is let pass, and no more.
TYPED_TEST(StartStateTest, LiesOnTheConstraintsToGatheredRoundOff) {
  using S = TypeParam;
  const auto below = [&](long units) {
    const S y = -1 - S(units) * epsilon<S>();
    return this->start_refusal("{\"q\": [\"0\", \"" + to_text(y) + "\"], \"p\": [\"0\", \"0\"]}");
  };
  EXPECT_EQ(below(1L << 15), "");
  expect_words(below(1L << 19), {"constraint 1"});
}

TYPED_TEST(StartStateTest, IsOfItsOwnScene) {
  const auto of = [&](const std::string& name) {
    return this->start_refusal("{\"scene\": \"" + name + "\", \"q\": [\"0\", \"-1\"], \"p\": [\"0\", \"0\"]}");
  };
  EXPECT_EQ(of(this->text.name), "");
  EXPECT_EQ(of("another/path/" + this->text.name), "") << "of the same file";
  expect_words(of("kepler"), {"'scene' is 'kepler'"});
}

TYPED_TEST(StartStateTest, IsRefusedWithFileAndKey) {
  const auto expect = [&](const std::string& json, const char* part) {
    const std::string message = this->start_refusal(json);
    EXPECT_TRUE(message.starts_with("--start: 'a.json': ")) << json << ": " << message;
    expect_words(message, {part});
  };
  expect("{", "no JSON");
  expect("[]", "object");
  expect(R"({"p": ["0", "0"]})", "'q'");
  expect(R"({"q": "0", "p": ["0", "0"]})", "'q' is no list");
  expect(R"({"q": ["0", -1], "p": ["0", "0"]})", "'q', entry 2: -1 is no text");
  expect(R"({"q": ["0", "-1"], "p": ["0", "1+"]})", "'p', entry 2");
  expect(R"x({"q": ["0", "-1"], "p": ["0", "log(-1)"]})x", "'p', entry 2");
  expect(R"({"q": ["0", "-1"], "p": ["0"]})", "'p' has 1 entries");
  expect(R"({"q": ["0", "-1"], "p": ["0", "0"], "p_carry": ["0", "0"]})", "'q_carry'");
  expect(R"({"q": ["0", "-1"], "p": ["0", "0"], "scene": 3})", "'scene' is no text");
}

}  // namespace
}  // namespace hbvm::core

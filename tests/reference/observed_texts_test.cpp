#include "reference/observed_texts.hpp"

#include "printing.hpp"
#include "reference/request_of.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

/// The texts have the digits in which states agree: of a sum that cancels, fewer.
TEST(ObservedTexts, HaveTheDigitsInWhichStatesAgree) {
  const PrecisionScope digits(40);
  ReferenceRequest request = request_of("simple_pendulum", {"1"}, 20);
  for (const char* text : {"bob.x", "bob.x - 3/5"})
    request.scene.observations.push_back({text, Expression::parse(text, Expression::Syntax::observation)});
  const Assembled<Mpfr> scene = assemble<Mpfr>(request.scene);
  ExactPoint one{scene.q0, scene.p0, {}}, other = one;
  one.q[0] = literal<Mpfr>("0.600000001234567890123456789");
  other.q[0] = literal<Mpfr>("0.600000001234567890123499999");
  Reference reference;
  reference.times.resize(1);
  add_observed_texts(reference, request, scene.problem, {{one}, {other}});
  ASSERT_EQ(reference.times[0].observed.size(), 2u);
  EXPECT_EQ(reference.observed_names[1], "bob.x - 3/5");
  EXPECT_EQ(reference.times[0].observed[0], "0.600000001234567890123");
  EXPECT_EQ(reference.times[0].observed[1].substr(0, 14), "1.234567890123");
  EXPECT_LT(reference.times[0].observed[1].size(), 22u);
}

/// Each component is changed by some units of its last digits, another way each.
TEST(ObservedTexts, ShakeTheLastDigits) {
  const PrecisionScope digits(30);
  const ExactPoint point{Vector<Mpfr>{{Mpfr(1), Mpfr(-2)}}, Vector<Mpfr>{{Mpfr(0), Mpfr(3)}}, {}};
  const ExactPoint moved = shaken({point}).front();
  EXPECT_GT(moved.q[0], point.q[0]);
  EXPECT_LT(moved.q[1], point.q[1]);
  EXPECT_EQ(moved.p[0], point.p[0]);
  EXPECT_LT(moved.p[1] - point.p[1], 1'000 * epsilon<Mpfr>());
}

}  // namespace
}  // namespace hbvm::core

#include "scene/nearest_position.hpp"

#include "scene/assembled.hpp"

namespace hbvm::core {
namespace {

template <class S>
class NearestPosition : public InDigits<50> {
 protected:
  /// Each link is a little too long.
  static Assembled<S> long_chain(int n) { return assembled<S>(chain(n, "0.80001"), Consistency::unchecked); }
};
TYPED_TEST_SUITE(NearestPosition, AllScalars, ScalarNames);

/// Of few constraints and of many.
TYPED_TEST(NearestPosition, FulfilsTheConstraints) {
  using S = TypeParam;
  for (const int n : {3, 140}) {
    const Assembled<S> scene = this->long_chain(n);
    const Vector<S> q = nearest_position(scene.problem, scene.q0);
    for (const Constraint<S>& constraint : scene.problem.constraints)
      EXPECT_TRUE(value(constraint, 2, q).vanishes()) << constraint.name;
    EXPECT_LT(max_norm(Vector<S>(q - scene.q0)), S(n) / 1'000);
    // Momenta likewise.
    StateEvaluator<S> point(scene.problem);
    const Vector<S> p = point.tangential(q, Vector<S>(Vector<S>::Constant(q.size(), S(1)))),
                    left = point.hidden_constraints(q, p);
    EXPECT_LE(max_norm(left), S(1'000 * n) * epsilon<S>());
  }
}

TYPED_TEST(NearestPosition, IsRefusedWhereThereIsNone) {
  using S = TypeParam;
  Assembled<S> scene = this->long_chain(2);
  scene.problem.constraints.push_back(scene.problem.constraints.front());
  std::get<Rod<S>>(scene.problem.constraints.back().form).square = 9;
  expect_words(message_of([&] { nearest_position(scene.problem, scene.q0); }),
               {"no consistent position", "the search ended where these are off: rod '", "e-"});
}

/// Where the slope of g falls off, a full step of Newton's method from far away leads farther away.
TYPED_TEST(NearestPosition, IsFoundWhereFullStepsLeadAway) {
  using S = TypeParam;
  const Assembled<S> scene = assembled<S>(
      "dimension = 2\nbody = [{ name = \"a\", mass = 1, position = [1, 0.3], velocity = [0, 1] }]\n"
      "constraint = [{ kind = \"formula\", on = \"a\", g = \"atan(5*x)\" }]\n",
      Consistency::unchecked);
  const Vector<S> q = nearest_position(scene.problem, scene.q0);
  EXPECT_EQ(q[0], 0);
  EXPECT_EQ(q[1], scene.q0[1]);
}

/// Bars of a chain that are drawn up to thirty degrees off, and whose ends do not meet.
TYPED_TEST(NearestPosition, IsFoundFromARoughSketch) {
  using S = TypeParam;
  const auto bar = [](int n, const char* angle, const char* position) {
    return "[[rigid_body]]\nname = \"b" + std::to_string(n) + "\"\nposition = " + position +
           "\nvelocity = [0, 0]\nmass = " + std::to_string(n) +
           "\ncenter = [1, 0]\ninertia = 0.3\norientation = " + angle + "\nangular_velocity = 0\n";
  };
  const auto joint = [](const std::string& a, const std::string& b) {
    return "[[constraint]]\nkind = \"ball_joint\"\nbetween = [" + a + ", " + b + "]\n";
  };
  const auto end = [](int n, int at) {
    return "{ of = \"b" + std::to_string(n) + "\", at = [" + std::to_string(at) + ", 0] }";
  };
  // A four-bar linkage with sides of 2 and a ground of 3, whose bars stand at 60, 14.5 and 120 degrees.
  const std::string text =
      "dimension = 2\n[[point]]\nname = \"A\"\nposition = [0, 0]\n[[point]]\nname = \"B\"\n"
      "position = [3, 0]\n" +
      bar(1, "1.5", "[0.1, 0]") + bar(2, "-0.3", "[0.4, 1.9]") + bar(3, "2.6", "[3, 0.3]") + joint("\"A\"", end(1, 0)) +
      joint(end(1, 2), end(2, 0)) + joint(end(2, 2), end(3, 2)) + joint("\"B\"", end(3, 0));
  const Assembled<S> scene = assembled<S>(text, Consistency::unchecked);
  const Vector<S> q = nearest_position(scene.problem, scene.q0);
  for (const Constraint<S>& constraint : scene.problem.constraints)
    EXPECT_TRUE(value(constraint, 2, q).vanishes()) << constraint.name;
  EXPECT_LT(max_norm(Vector<S>(q - scene.q0)), 1);
}

}  // namespace
}  // namespace hbvm::core

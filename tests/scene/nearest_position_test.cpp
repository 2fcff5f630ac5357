#include "scene/nearest_position.hpp"

#include "printing.hpp"
#include "problem/state_evaluator.hpp"
#include "scene/assemble.hpp"
#include "scene/scene_text.hpp"

namespace hbvm::core {
namespace {

template <class S>
class NearestPosition : public ::testing::Test {
 protected:
  PrecisionScope digits{50};

  /// n links of length 1, each a little too long.
  static Assembled<S> chain(int n) {
    std::string text = "dimension = 2\n[[point]]\nname = \"0\"\nposition = [0, 0]\n", rods;
    for (int i = 1; i <= n; ++i) {
      const std::string name = std::to_string(i);
      text += "[[body]]\nname = \"" + name + "\"\nmass = 1\nposition = [\"" + name + "*3/5\", \"" + name +
              "*0.80001\"]\nvelocity = [0, 0]\n";
      rods += rod(std::to_string(i - 1), name, "1");
    }
    return assemble<S>(read_scene(text + rods, "test.toml"), Consistency::unchecked);
  }
};
TYPED_TEST_SUITE(NearestPosition, AllScalars, ScalarNames);

/// Of few constraints and of many.
TYPED_TEST(NearestPosition, FulfilsTheConstraints) {
  using S = TypeParam;
  for (const int n : {3, 140}) {
    const Assembled<S> scene = this->chain(n);
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
  Assembled<S> scene = this->chain(2);
  scene.problem.constraints.push_back(scene.problem.constraints.front());
  std::get<Rod<S>>(scene.problem.constraints.back().form).square = 9;
  EXPECT_THROW(nearest_position(scene.problem, scene.q0), InputError);
}

}  // namespace
}  // namespace hbvm::core

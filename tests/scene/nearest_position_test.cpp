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
  EXPECT_THROW(nearest_position(scene.problem, scene.q0), InputError);
}

}  // namespace
}  // namespace hbvm::core

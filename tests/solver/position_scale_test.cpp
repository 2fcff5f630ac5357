#include "solver/position_scale.hpp"

#include "printing.hpp"
#include "problem/dense.hpp"

namespace hbvm::core {
namespace {

template <class S>
class PositionScaleTest : public InDigits<50> {
 protected:
  RandomValues<S> random{43};

  /// A body, a rigid body with two directors, and another body, in space.
  static Problem<S> problem() {
    Problem<S> result;
    result.dimension = 3;
    result.mass.add_scalar(3, S(2));
    Matrix<S> M = mass_block<S>(9);
    M(0, 4) = M(4, 0) = S(-1) / 8;
    result.mass.add_full(M);
    result.mass.add_scalar(3, S(3) / 4);
    for (Index b = 0; b < 5; ++b) result.blocks.push_back({3 * b, b != 2 && b != 3});
    return result;
  }

  /// sum_l |M_jl| / |h| times the greatest of the positions, or of the directors, whichever l is of.
  static Vector<S> expected(const Problem<S>& problem, const Vector<S>& q, const S& h) {
    const Matrix<S> M = dense_mass(problem.mass);
    S space = 0, directors = 0;
    const auto turns = [](Index j) { return j >= 6 && j < 12; };
    for (Index j = 0; j < q.size(); ++j) raise_magnitude(turns(j) ? directors : space, q[j]);
    Vector<S> scale = Vector<S>::Zero(q.size());
    for (Index j = 0; j < q.size(); ++j)
      for (Index l = 0; l < q.size(); ++l) scale[j] += magnitude(S(M(j, l) / h)) * (turns(l) ? directors : space);
    return scale;
  }
};
TYPED_TEST_SUITE(PositionScaleTest, AllScalars, ScalarNames);

TYPED_TEST(PositionScaleTest, IsTheSumOfTheDefinition) {
  using S = TypeParam;
  const Problem<S> problem = this->problem();
  PositionScale<S> position_scale(problem);
  Vector<S> q = this->random.vector(problem.m()), scale(problem.m());
  q.segment(6, 6) *= S(100);
  for (const S& h : {S(S(1) / 8), S(S(-1) / 8), S(4)})
    for (int n = 0; n < 2; ++n) {
      position_scale.evaluate(q, h, scale);
      const Vector<S> exact = this->expected(problem, q, h);
      for (Index j = 0; j < q.size(); ++j)
        EXPECT_LE(magnitude(S(scale[j] - exact[j])), 32 * epsilon<S>() * exact[j]) << j << ", h = " << h;
      q *= S(-3) / 4;
    }
}

}  // namespace
}  // namespace hbvm::core

#include "problem/constraint.hpp"

#include "printing.hpp"
#include "problem/dense.hpp"

namespace hbvm::core {
namespace {

template <class S>
class ConstraintTest : public InDigits<50> {
 protected:
  RandomValues<S> random{47};
};
TYPED_TEST_SUITE(ConstraintTest, AllScalars, ScalarNames);

TYPED_TEST(ConstraintTest, CurvatureIsTheSecondDifference) {
  for (const Index d : {2, 3}) {
    const Problem<TypeParam> problem = constrained_problem<TypeParam>(d);
    const auto q = this->random.vector(problem.m()), v = this->random.vector(problem.m());
    const auto expected = dense_curvature(problem, q, v);
    for (Index a = 0; a < problem.nu(); ++a)
      EXPECT_LE(
          magnitude(TypeParam(curvature(problem.constraints[static_cast<std::size_t>(a)], d, q, v) - expected[a])),
          512 * epsilon<TypeParam>())
          << a;
  }
}

/// v^T H v with its entries, none of which is 0, is the curvature, and they are the same across the diagonal.
TYPED_TEST(ConstraintTest, SecondDerivativesAreThoseOfTheCurvature) {
  for (const Index d : {2, 3}) {
    const Problem<TypeParam> problem = constrained_problem<TypeParam>(d);
    const auto q = this->random.vector(problem.m()), v = this->random.vector(problem.m());
    std::size_t entries = 0;
    for (const auto& constraint : problem.constraints) {
      if (degree(constraint) != 2) continue;
      auto rows = second_derivatives(constraint, d);
      TypeParam sum = 0;
      for (const auto& [i, row] : rows)
        for (const auto& [j, h] : row) {
          ++entries;
          EXPECT_NE(h, 0);
          EXPECT_EQ(h, rows[j][i]);
          sum += v[i] * h * v[j];
        }
      EXPECT_LE(magnitude(TypeParam(sum - curvature(constraint, d, q, v))), 512 * epsilon<TypeParam>());
    }
    EXPECT_GT(entries, 0u);
  }
}

TYPED_TEST(ConstraintTest, SizeBoundsTheRoundOff) {
  for (const Index d : {2, 3}) {
    const Problem<TypeParam> problem = constrained_problem<TypeParam>(d);
    for (int trial = 0; trial < 20; ++trial) {
      const Vector<TypeParam> q = this->random.vector(problem.m()) * TypeParam(1L << (trial % 10));
      for (const auto& constraint : problem.constraints) {
        const auto at_q = value(constraint, d, q);
        EXPECT_GE(at_q.size, magnitude(at_q.g));
        // One unit in the last place of every coordinate moves g by no more than a few eps times its size.
        Vector<TypeParam> moved = q;
        for (Index i = 0; i < q.size(); ++i) moved[i] += epsilon<TypeParam>() * this->random.value() * q[i];
        EXPECT_LE(magnitude(TypeParam(value(constraint, d, moved).g - at_q.g)), 16 * epsilon<TypeParam>() * at_q.size);
      }
    }
  }
}

}  // namespace
}  // namespace hbvm::core

#include "problem/gram_factor.hpp"

#include "printing.hpp"
#include "problem/dense.hpp"

namespace hbvm::core {
namespace {

template <class S>
class GramFactors : public InDigits<50> {};
TYPED_TEST_SUITE(GramFactors, AllScalars, ScalarNames);

/// A ring of rods whose neighbours in the list are far apart in it.
TYPED_TEST(GramFactors, SolveWhatTheDenseMatrixIs) {
  using S = TypeParam;
  constexpr Index n = 9;
  Problem<S> problem;
  problem.dimension = problem.potential.dimension = 2;
  for (Index i = 0; i < n; ++i) problem.mass.add_scalar(2, S(1 + i % 3));
  problem.potential.m = problem.m();
  Vector<S> q(2 * n), x(n);
  for (Index i = 0; i < n; ++i) {
    const Index a = 4 * i % n, b = (4 * i + 1) % n;
    problem.constraints.push_back({"rod", Rod<S>{{{{2 * a, S(1)}, {2 * b, S(-1)}}, {}}, S(1)}});
    q[2 * i] = S((i * i + 3) % 7);
    q[2 * i + 1] = S((i * i * i + 2 * i) % 11);
    x[i] = S(i % 4 - 1);
  }
  ConstraintGradient<S> gradient(problem, 1);
  gradient.update(lanes(q));
  Matrix<S> gram;
  gradient.gram(gram);
  GramFactor<S> factor;
  ASSERT_TRUE(factor.factor(gradient, n));
  Vector<S> solution = x;
  factor.solve(solution);
  for (Index i = 0; i < n; ++i) {
    S sum = 0, size = 0;
    for (Index j = 0; j < n; ++j) {
      sum += gram(i, j) * solution[j];
      size += magnitude(S(gram(i, j) * solution[j]));
    }
    EXPECT_LE(magnitude(S(sum - x[i])), 1'000 * epsilon<S>() * size) << i;
  }
}

}  // namespace
}  // namespace hbvm::core

#include "problem/constraint_gradient.hpp"

#include <set>

#include "printing.hpp"
#include "problem/dense.hpp"

namespace hbvm::core {
namespace {

template <class S>
class ConstraintGradientTest : public InDigits<50> {
 protected:
  static constexpr Index count = 3;
  RandomValues<S> random{53};

  /// Coordinates and gradients are of the order of 1 to 10, and sums have at most 12 terms.
  S tolerance() const { return S(1'024) * epsilon<S>(); }

  static Vector<S> lane(const Matrix<S>& rows, Index i) { return rows.row(i).transpose(); }
};
TYPED_TEST_SUITE(ConstraintGradientTest, AllScalars, ScalarNames);

TYPED_TEST(ConstraintGradientTest, AgreesWithDenseMatricesInEveryLane) {
  using S = TypeParam;
  for (const Index d : {2, 3}) {
    const Problem<S> problem = constrained_problem<S>(d);
    const Index m = problem.m(), nu = problem.nu();
    const Matrix<S> W = dense_inverse(dense_mass(problem.mass));
    ConstraintGradient<S> gradient(problem, this->count);
    for (int update = 0; update < 2; ++update) {
      const Matrix<S> q = this->random.matrix(this->count, m), v = this->random.matrix(this->count, m),
                      lambda = this->random.matrix(this->count, nu), start = this->random.matrix(this->count, m);
      Matrix<S> g(this->count, nu), rates_of(this->count, 1);
      gradient.update(lanes(q), g);
      Matrix<S> force = start, velocity = start;
      gradient.add_times(lambda, lanes(force));
      gradient.add_weighted_times(lambda, lanes(velocity));
      for (Index i = 0; i < this->count; ++i) {
        const Matrix<S> G = dense_gradient(problem, this->lane(q, i)), WG = W.lazyProduct(G);
        const Vector<S> rates = times<S>(G.transpose(), this->lane(v, i));
        for (Index a = 0; a < nu; ++a) {
          gradient.transposed_times(a, lanes(v), rates_of.data());
          EXPECT_LE(magnitude(S(rates_of(i, 0) - rates[a])), this->tolerance())
              << problem.constraints[static_cast<std::size_t>(a)].name;
        }
        const Vector<S> values = dense_constraints<S>(problem, this->lane(q, i));
        EXPECT_LE(max_norm(Vector<S>(g.row(i).transpose() - values)), this->tolerance());
        const Vector<S> pull = this->lane(start, i) + times(G, this->lane(lambda, i)),
                        push = this->lane(start, i) + times(WG, this->lane(lambda, i));
        EXPECT_LE(max_norm(Vector<S>(this->lane(force, i) - pull)), this->tolerance());
        EXPECT_LE(max_norm(Vector<S>(this->lane(velocity, i) - push)), this->tolerance());
      }
    }
  }
}

TYPED_TEST(ConstraintGradientTest, EachConstraintStandsInItsColumn) {
  using S = TypeParam;
  const Problem<S> problem = constrained_problem<S>(3);
  const Vector<S> q = this->random.vector(problem.m());
  const Matrix<S> G = dense_gradient(problem, q);
  ConstraintGradient<S> gradient(problem, 1);
  gradient.update(lanes(q));
  for (Index a = 0; a < problem.nu(); ++a) {
    Matrix<S> unit = Matrix<S>::Zero(1, problem.nu());
    unit(0, a) = 1;
    Vector<S> column = Vector<S>::Zero(problem.m());
    gradient.add_times(unit, lanes(column));
    EXPECT_LE(max_norm(Vector<S>(column - G.col(a))), this->tolerance()) << a;
    for (Index j = 0; j < problem.m(); ++j) EXPECT_EQ(column[j] == 0, magnitude(G(j, a)) <= this->tolerance());
  }
}

TYPED_TEST(ConstraintGradientTest, CouplingsAreTheProductsAcrossLanes) {
  using S = TypeParam;
  for (const Index d : {2, 3}) {
    const Problem<S> problem = constrained_problem<S>(d);
    const Index nu = problem.nu();
    const Matrix<S> q = this->random.matrix(this->count, problem.m()), W = dense_inverse(dense_mass(problem.mass));
    ConstraintGradient<S> gradient(problem, this->count);
    gradient.update(lanes(q));
    for (Index i = 0; i < this->count; ++i) {
      for (Index j = 0; j < this->count; ++j) {
        const Matrix<S> WG = W.lazyProduct(dense_gradient(problem, this->lane(q, j)));
        Matrix<S> expected = dense_gradient(problem, this->lane(q, i)).transpose().lazyProduct(WG);
        for (const auto& pair : gradient.couplings()) {
          Matrix<S> entries(this->count, this->count);
          gradient.coupling(pair, gradient, entries.data());
          EXPECT_LE(magnitude(S(entries(i, j) - expected(pair.a, pair.b))), 8 * this->tolerance())
              << pair.a << " " << pair.b;
          expected(pair.a, pair.b) = 0;
        }
        EXPECT_LE(max_norm(expected), 8 * this->tolerance()) << "a pair that couples is not listed";
      }
    }
    EXPECT_LT(gradient.couplings().size(), static_cast<std::size_t>(nu * nu));
  }
}

/// Every pair of couplings() once, the later one of two as the transpose of the other.
TYPED_TEST(ConstraintGradientTest, OwnCouplingsAreThoseOfAllPairs) {
  using S = TypeParam;
  for (const Index d : {2, 3}) {
    const Problem<S> problem = constrained_problem<S>(d);
    ConstraintGradient<S> gradient(problem, this->count);
    gradient.update(lanes(this->random.matrix(this->count, problem.m())));
    Matrix<S> own(this->count, this->count), entries = own;
    std::set<std::pair<Index, Index>> seen;
    gradient.for_each_own_coupling(this->count, own.data(), [&](Index a, Index b, const auto& at) {
      EXPECT_TRUE(seen.emplace(a, b).second) << a << " " << b;
      for (const auto& pair : gradient.couplings())
        if (pair.a == a && pair.b == b) gradient.coupling(pair, gradient, entries.data());
      for (Index i = 0; i < this->count; ++i)
        for (Index j = 0; j < this->count; ++j)
          EXPECT_LE(magnitude(S(at(i, j) - entries(i, j))), 8 * this->tolerance()) << a << " " << b;
    });
    EXPECT_EQ(seen.size(), gradient.couplings().size());
  }
}

TYPED_TEST(ConstraintGradientTest, GramMatrixIsThatOfTheFirstLane) {
  using S = TypeParam;
  for (const Index d : {2, 3}) {
    const Problem<S> problem = constrained_problem<S>(d);
    const Matrix<S> q = this->random.matrix(this->count, problem.m()), W = dense_inverse(dense_mass(problem.mass)),
                    G = dense_gradient(problem, this->lane(q, 0));
    ConstraintGradient<S> gradient(problem, this->count);
    gradient.update(lanes(q));
    Matrix<S> gram = this->random.matrix(2, 5);  // overwritten
    gradient.gram(gram);
    const Matrix<S> WG = W.lazyProduct(G), expected = G.transpose().lazyProduct(WG);
    ASSERT_EQ(gram.rows(), problem.nu());
    ASSERT_EQ(gram.cols(), problem.nu());
    EXPECT_LE(max_norm(Matrix<S>(gram - expected)), 8 * this->tolerance());
  }
}

TYPED_TEST(ConstraintGradientTest, CouplesOverAFullMassBlockWithoutSharedCoordinates) {
  using S = TypeParam;
  Problem<S> problem;
  problem.dimension = 2;
  problem.mass.add_full(mass_block<S>(4));
  Vector<S> normal(2);
  normal << S(1), S(0);
  problem.constraints = {{"one", Plane<S>{{0}, normal, S(0)}}, {"other", Plane<S>{{2}, normal, S(0)}}};
  ConstraintGradient<S> gradient(problem, 1);
  const Vector<S> q = this->random.vector(4);
  gradient.update(lanes(q));
  const Matrix<S>& W = problem.mass.blocks()[0].W;
  ASSERT_EQ(gradient.couplings().size(), 4u);
  for (const auto& pair : gradient.couplings()) {
    S entry;
    gradient.coupling(pair, gradient, &entry);
    EXPECT_EQ(entry, W(2 * pair.a, 2 * pair.b));
  }
}

TYPED_TEST(ConstraintGradientTest, SeparateBodiesDoNotCouple) {
  using S = TypeParam;
  Problem<S> problem = free_bodies<S>(2, {1, 1});
  Vector<S> normal(2);
  normal << S(1), S(1);
  problem.constraints = {{"one", Plane<S>{{0}, normal, S(0)}}, {"other", Plane<S>{{2}, normal, S(0)}}};
  const ConstraintGradient<S> gradient(problem, 1);
  ASSERT_EQ(gradient.couplings().size(), 2u);
  for (const auto& pair : gradient.couplings()) EXPECT_EQ(pair.a, pair.b);
}

TYPED_TEST(ConstraintGradientTest, AnAngleToAFixedDirectionIsLinear) {
  using S = TypeParam;
  Problem<S> problem = free_bodies<S>(2, {1});
  Vector<S> direction(2);
  direction << S(3), S(-4);
  problem.constraints = {{"angle", DisplacementProduct<S>{{{{0, S(1)}}, {}}, {{}, direction}, S(1)}}};
  ConstraintGradient<S> gradient(problem, 1);
  for (int update = 0; update < 3; ++update) {
    const Vector<S> q = this->random.vector(2);
    gradient.update(lanes(q));
    Matrix<S> unit = Matrix<S>::Ones(1, 1);
    Vector<S> column = Vector<S>::Zero(2);
    gradient.add_times(unit, lanes(column));
    EXPECT_EQ(column, direction) << "update " << update;
  }
}

TYPED_TEST(ConstraintGradientTest, NoConstraintsAreAllowed) {
  using S = TypeParam;
  Problem<S> problem = free_bodies<S>(2, {1});
  ConstraintGradient<S> gradient(problem, 2);
  const Matrix<S> q = this->random.matrix(2, 2);
  Matrix<S> out = q;
  gradient.update(lanes(q));
  gradient.add_times(Matrix<S>(2, 0), lanes(out));
  EXPECT_EQ(out, q);
  EXPECT_TRUE(gradient.couplings().empty());
}

TYPED_TEST(ConstraintGradientTest, StoresWhatIsNotZero) {
  for (const Index d : {2, 3}) {
    const Problem<TypeParam> problem = constrained_problem<TypeParam>(d);
    // pin 1, rod 2, angle 3, quadrics and plane 1 each, centres 3 bodies
    EXPECT_EQ((ConstraintGradient<TypeParam>(problem, 4).stored()), (1 + 2 + 3 + 1 + 1 + 1 + 3) * d);
  }
}

/// The columns of a rod between two bodies are those of one and their negatives: half of the products do.
TYPED_TEST(ConstraintGradientTest, CountsHalfOfTheProductsOfARod) {
  using S = TypeParam;
  Problem<S> problem = free_bodies<S>(3, {1, 2});
  Vector<S> pivot(3);
  pivot << S(1), S(2), S(3);
  problem.constraints = {{"rod", Rod<S>{{{{3, S(1)}, {0, S(-1)}}, {}}, S(1)}},
                         {"pin", Rod<S>{{{{0, S(1)}}, pivot}, S(1)}}};
  ConstraintGradient<S> gradient(problem, 5);
  OperationCounts rod, pin, times;
  rod.add_dots(5, 3);
  rod.add(Op::subtract, 5 * 3);
  pin.add_dots(5, 3);
  times.add_products(5 * (3 + 3));
  times.add(Op::subtract, 5 * 3);
  EXPECT_EQ(gradient.transposed_operations(0), rod);
  EXPECT_EQ(gradient.transposed_operations(1), pin);
  EXPECT_EQ(gradient.times_operations(), times);

  // Opposite forces on both ends, to the last bit.
  const Matrix<S> q = this->random.matrix(5, 6), lambda = this->random.matrix(5, 2);
  gradient.update(lanes(q));
  Matrix<S> only_rod = lambda, force = Matrix<S>::Zero(5, 6);
  only_rod.col(1).setZero();
  gradient.add_times(only_rod, lanes(force));
  EXPECT_EQ(force.leftCols(3), -force.rightCols(3));
  EXPECT_NE(force(0, 0), S(0));
}

TYPED_TEST(ConstraintGradientTest, CountsOperationsOfARod) {
  using S = TypeParam;
  Problem<S> problem = free_bodies<S>(3, {1, 2});
  const Displacement<S> x{{{0, S(1)}, {3, S(-1)}}, {}};
  problem.constraints = {{"rod", Rod<S>{x, S(1)}}};
  // In each lane: x = a - b, grad_a = x + x, grad_b = -grad_a, and W grad_b.
  OperationCounts expected;
  expected.add(Op::subtract, 3);
  expected.add(Op::add, 3);
  expected.add(Op::negate, 3);
  expected.add(Op::multiply, 3);
  const ConstraintGradient<S> gradient(problem, 5);
  EXPECT_EQ(gradient.operations() + gradient.weighing_operations(), 5 * expected);
}

}  // namespace
}  // namespace hbvm::core

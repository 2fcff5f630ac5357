#include "problem/mass_matrix.hpp"

#include "hbvm/error.hpp"
#include "printing.hpp"
#include "problem/dense.hpp"

namespace hbvm::core {
namespace {

template <class S>
class MassMatrixTest : public InDigits<50> {
 protected:
  RandomValues<S> random{43};

  /// B^T B + 1, for a random B.
  Matrix<S> random_block(Index n) {
    const Matrix<S> B = random.matrix(n, n);
    Matrix<S> M = B.transpose().lazyProduct(B);
    for (Index j = 0; j < n; ++j) {
      M(j, j) += 1;
      for (Index i = 0; i < j; ++i) M(j, i) = M(i, j);
    }
    return M;
  }

  MassMatrix<S> mixed() {
    MassMatrix<S> mass;
    mass.add_scalar(2, S(1));
    mass.add_full(random_block(3));
    mass.add_scalar(3, S(5) / 3);
    mass.add_full(random_block(2));
    return mass;
  }
};
TYPED_TEST_SUITE(MassMatrixTest, AllScalars, ScalarNames);

TYPED_TEST(MassMatrixTest, StacksItsBlocks) {
  const auto mass = this->mixed();
  EXPECT_EQ(mass.m(), 10);
  ASSERT_EQ(mass.blocks().size(), 4u);
  const Index offsets[] = {0, 2, 5, 8}, sizes[] = {2, 3, 3, 2};
  for (std::size_t b = 0; b < 4; ++b) {
    EXPECT_EQ(mass.blocks()[b].offset, offsets[b]);
    EXPECT_EQ(mass.blocks()[b].size, sizes[b]);
    EXPECT_EQ(mass.blocks()[b].full, b % 2 == 1);
  }
}

TYPED_TEST(MassMatrixTest, InverseOfAFullBlock) {
  for (Index n = 1; n <= 12; ++n) {
    MassMatrix<TypeParam> mass;
    mass.add_full(this->random_block(n));
    const Matrix<TypeParam>&M = mass.blocks()[0].M, &W = mass.blocks()[0].W;
    const Matrix<TypeParam> defect = Matrix<TypeParam>(W.lazyProduct(M)) - Matrix<TypeParam>::Identity(n, n);
    // Entries of W are below 1; those of M below 1 + n; n products of which are summed.
    EXPECT_LE(max_norm(defect), TypeParam(n * n * (n + 1)) * epsilon<TypeParam>()) << n;
    EXPECT_EQ(W, (Matrix<TypeParam>(W.transpose())));
  }
}

TYPED_TEST(MassMatrixTest, InverseOfAnIllConditionedBlockIsRoundedOnce) {
  // [[a, a - 1], [a - 1, a]] has the inverse [[a, 1 - a], [1 - a, a]] / (2 a - 1).
  const TypeParam a = TypeParam(1L << 40);
  Matrix<TypeParam> M(2, 2);
  M << a, a - 1, a - 1, a;
  MassMatrix<TypeParam> mass;
  mass.add_full(M);
  const Matrix<TypeParam>& W = mass.blocks()[0].W;
  const TypeParam eps = epsilon<TypeParam>();
  EXPECT_LE(magnitude(TypeParam(W(0, 0) * (2 * a - 1) / a - 1)), 3 * eps);
  EXPECT_LE(magnitude(TypeParam(W(0, 1) * (2 * a - 1) / (a - 1) + 1)), 3 * eps);
}

TYPED_TEST(MassMatrixTest, VelocityAndMomentumAreInverse) {
  const auto mass = this->mixed();
  const Vector<TypeParam> v = this->random.vector(mass.m());
  Vector<TypeParam> back(mass.m());
  const Vector<TypeParam> momentum = mass.momentum(v);
  mass.velocity(lanes(momentum), lanes(back));
  EXPECT_LE(max_norm(Vector<TypeParam>(back - v)), 64 * epsilon<TypeParam>());
  const Vector<TypeParam> p = this->random.vector(mass.m());
  mass.velocity(lanes(p), lanes(back));
  EXPECT_LE(max_norm(Vector<TypeParam>(mass.momentum(back) - p)), 64 * epsilon<TypeParam>());
}

TYPED_TEST(MassMatrixTest, MomentumIsTheDenseProduct) {
  const auto mass = this->mixed();
  const Vector<TypeParam> v = this->random.vector(mass.m());
  const Vector<TypeParam> expected = times(dense_mass(mass), v);
  EXPECT_LE(max_norm(Vector<TypeParam>(mass.momentum(v) - expected)), 64 * epsilon<TypeParam>());
}

TYPED_TEST(MassMatrixTest, EveryLaneIsTreatedAlike) {
  const auto mass = this->mixed();
  const Matrix<TypeParam> p = this->random.matrix(3, mass.m());
  Matrix<TypeParam> v = this->random.matrix(3, mass.m());
  mass.velocity(lanes(p), lanes(v));
  for (Index i = 0; i < 3; ++i) {
    const Vector<TypeParam> one = p.row(i).transpose();
    Vector<TypeParam> expected(mass.m());
    mass.velocity(lanes(one), lanes(expected));
    EXPECT_EQ(Vector<TypeParam>(v.row(i).transpose()), expected);
  }
}

TYPED_TEST(MassMatrixTest, MassOneChangesNothing) {
  MassMatrix<TypeParam> mass;
  mass.add_scalar(3, TypeParam(1));
  const Vector<TypeParam> p = this->random.vector(3);
  Vector<TypeParam> v(3);
  mass.velocity(lanes(p), lanes(v));
  EXPECT_EQ(v, p);
  EXPECT_EQ(mass.momentum(p), p);
  EXPECT_EQ(mass.operations().total(), 0u);
}

TYPED_TEST(MassMatrixTest, CountsOperations) {
  OperationCounts expected;
  expected.add_dots(3, 3);
  expected.add_dots(2, 2);
  expected.add(Op::multiply, 3);
  EXPECT_EQ(this->mixed().operations(), expected);
}

TYPED_TEST(MassMatrixTest, RefusesMassesThatAreNotPositive) {
  MassMatrix<TypeParam> mass;
  for (const TypeParam& bad : {TypeParam(0), TypeParam(-1), std::numeric_limits<TypeParam>::quiet_NaN()})
    EXPECT_THROW(mass.add_scalar(3, bad), InputError) << bad;
  EXPECT_EQ(mass.m(), 0);
}

TYPED_TEST(MassMatrixTest, RefusesWhatIsNotSymmetric) {
  Matrix<TypeParam> M = this->random_block(3);
  M(2, 0) += epsilon<TypeParam>();
  MassMatrix<TypeParam> mass;
  EXPECT_THROW(mass.add_full(M), InputError);
}

TYPED_TEST(MassMatrixTest, RefusesWhatIsNotPositiveDefinite) {
  Matrix<TypeParam> indefinite(2, 2), semidefinite(2, 2), negative(1, 1), nan(1, 1);
  indefinite << TypeParam(1), TypeParam(2), TypeParam(2), TypeParam(1);
  semidefinite << TypeParam(1), TypeParam(1), TypeParam(1), TypeParam(1);
  negative << TypeParam(-1);
  nan << std::numeric_limits<TypeParam>::quiet_NaN();
  MassMatrix<TypeParam> mass;
  for (const auto& M : {indefinite, semidefinite, negative, nan}) EXPECT_THROW(mass.add_full(M), InputError) << M(0, 0);
  EXPECT_EQ(mass.m(), 0);
}

}  // namespace
}  // namespace hbvm::core

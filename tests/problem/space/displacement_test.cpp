#include "problem/space/displacement.hpp"

#include "printing.hpp"
#include "scalar/random_values.hpp"

namespace hbvm::core {
namespace {

template <class S>
class LanesTest : public InDigits<50> {
 protected:
  static constexpr Index d = 2, count = 3, m = 6;
  RandomValues<S> random{41};
  Matrix<S> q = random.matrix(count, m);

  /// The displacement in every lane, written over numbers that must not shine through.
  Matrix<S> displaced(const Displacement<S>& x) {
    Matrix<S> out = random.matrix(count, d);
    displace(x, d, lanes(std::as_const(q)), out.data(), count);
    return out;
  }
};
TYPED_TEST_SUITE(LanesTest, AllScalars, ScalarNames);

TYPED_TEST(LanesTest, IndexACoordinateThenALane) {
  const auto view = lanes(std::as_const(this->q));
  EXPECT_EQ(view.count, this->count);
  for (Index j = 0; j < this->m; ++j)
    for (Index i = 0; i < this->count; ++i) EXPECT_EQ(view[j][i], this->q(i, j));
}

TYPED_TEST(LanesTest, AVectorIsOneLane) {
  Vector<TypeParam> v = this->random.vector(4);
  const Lanes<const TypeParam> view = lanes(v);
  EXPECT_EQ(view.count, 1);
  for (Index j = 0; j < 4; ++j) EXPECT_EQ(view[j], &v[j]);
}

TYPED_TEST(LanesTest, DisplacementOfOneBody) {
  const Matrix<TypeParam> x = this->displaced({{{2, TypeParam(1)}}, {}});
  EXPECT_EQ(x, (Matrix<TypeParam>(this->q.middleCols(2, 2))));
}

TYPED_TEST(LanesTest, DisplacementOfTwoBodies) {
  const Matrix<TypeParam> x = this->displaced({{{4, TypeParam(1)}, {0, TypeParam(-1)}}, {}});
  EXPECT_EQ(x, (Matrix<TypeParam>(this->q.middleCols(4, 2) - this->q.middleCols(0, 2))));
}

TYPED_TEST(LanesTest, WeightsAndAShift) {
  Vector<TypeParam> shift(2);
  shift << TypeParam(5), TypeParam(-7);
  const TypeParam half = TypeParam(1) / 2;
  const Matrix<TypeParam> x = this->displaced({{{0, half}, {2, TypeParam(3)}, {4, TypeParam(-1)}}, shift});
  for (Index i = 0; i < this->count; ++i)
    for (Index j = 0; j < 2; ++j)
      EXPECT_EQ(x(i, j), ((half * this->q(i, j) + 3 * this->q(i, 2 + j)) - this->q(i, 4 + j)) + shift[j]);
}

TYPED_TEST(LanesTest, NegativeFirstWeight) {
  const Matrix<TypeParam> x = this->displaced({{{2, TypeParam(-1)}}, {}});
  EXPECT_EQ(x, (Matrix<TypeParam>(-this->q.middleCols(2, 2))));
}

TYPED_TEST(LanesTest, AFixedDisplacementIsItsShift) {
  Vector<TypeParam> shift(2);
  shift << TypeParam(5), TypeParam(-7);
  const Matrix<TypeParam> x = this->displaced({{}, shift});
  for (Index i = 0; i < this->count; ++i)
    for (Index j = 0; j < 2; ++j) EXPECT_EQ(x(i, j), shift[j]);
}

TYPED_TEST(LanesTest, AnEmptyDisplacementIsZero) {
  EXPECT_EQ(this->displaced({}), (Matrix<TypeParam>(Matrix<TypeParam>::Zero(this->count, this->d))));
}

TYPED_TEST(LanesTest, StrideLeavesTheRestAlone) {
  Matrix<TypeParam> out = Matrix<TypeParam>::Constant(5, 2, TypeParam(9));
  displace({{{2, TypeParam(1)}}, {}}, this->d, lanes(std::as_const(this->q)), out.data() + 1, Index{5});
  EXPECT_EQ(Matrix<TypeParam>(out.middleRows(1, 3)), Matrix<TypeParam>(this->q.middleCols(2, 2)));
  for (const Index row : {0, 4})
    for (const Index j : {0, 1}) EXPECT_EQ(out(row, j), 9);
}

TYPED_TEST(LanesTest, AddWeightedAdds) {
  const Vector<TypeParam> a = this->random.vector(4), before = this->random.vector(4);
  TypeParam t;
  for (const TypeParam& weight : {TypeParam(1), TypeParam(-1), TypeParam(0), TypeParam(5) / 3}) {
    Vector<TypeParam> r = before;
    add_weighted(r.data(), weight, a.data(), 3, t);
    for (Index i = 0; i < 3; ++i) EXPECT_EQ(r[i], before[i] + weight * a[i]) << weight;
    EXPECT_EQ(r[3], before[3]);
  }
}

TYPED_TEST(LanesTest, CountsOperations) {
  const TypeParam one = 1, half = one / 2;
  EXPECT_EQ(operations(Displacement<TypeParam>{{{0, one}}, {}}, 3).total(), 0u);
  OperationCounts rod;
  rod.add(Op::subtract, 3);
  EXPECT_EQ(operations(Displacement<TypeParam>{{{0, one}, {3, TypeParam(-1)}}, {}}, 3), rod);
  OperationCounts center;
  center.add(Op::multiply, 2);
  center.add_products(2);
  center.add(Op::add, 2);
  EXPECT_EQ(operations(Displacement<TypeParam>{{{0, half}, {2, half}}, Vector<TypeParam>::Zero(2)}, 2), center);
}

}  // namespace
}  // namespace hbvm::core

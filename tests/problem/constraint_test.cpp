#include "hbvm/problem/constraint.hpp"

#include "printing.hpp"
#include "problem/dense.hpp"

namespace hbvm {
namespace {

template <class S>
class ConstraintTest : public ::testing::Test {
 protected:
  PrecisionScope digits{50};
  RandomValues<S> random{47};

  static Vector<S> vector(std::initializer_list<int> entries) {
    Vector<S> v(static_cast<Index>(entries.size()));
    Index i = 0;
    for (const int entry : entries) v[i++] = S(entry);
    return v;
  }
  static Constraint<S> rod(const Displacement<S>& x, int square) {
    return {"rod", DisplacementProduct<S>{x, x, true, S(square)}};
  }
};
TYPED_TEST_SUITE(ConstraintTest, AllScalars, ScalarNames);

TYPED_TEST(ConstraintTest, RodBetweenTwoBodies) {
  const auto rod = this->rod({{{0, TypeParam(1)}, {3, TypeParam(-1)}}, {}}, 10);
  EXPECT_EQ(value(rod, 3, this->vector({1, 2, 3, 4, -2, 5})).g, 9 + 16 + 4 - 10);
  EXPECT_EQ(curvature(rod, 3, this->vector({1, 2, 3, 4, -2, 5})), 2 * (9 + 16 + 4));
  EXPECT_EQ(coordinates(rod, 3), (std::vector<Index>{0, 1, 2, 3, 4, 5}));
}

TYPED_TEST(ConstraintTest, PinAtAPoint) {
  const auto pin = this->rod({{{2, TypeParam(1)}}, this->vector({-1, 3})}, 5);
  EXPECT_EQ(value(pin, 2, this->vector({9, 9, 2, 4})).g, 1 + 49 - 5);
  EXPECT_EQ(curvature(pin, 2, this->vector({9, 9, 2, 4})), 2 * (4 + 16));
  EXPECT_EQ(coordinates(pin, 2), (std::vector<Index>{2, 3}));
}

TYPED_TEST(ConstraintTest, AngleBetweenRodsThatShareABody) {
  const Displacement<TypeParam> x{{{0, TypeParam(1)}, {2, TypeParam(-1)}}, {}},
      y{{{6, TypeParam(1)}, {2, TypeParam(-1)}}, {}};
  const Constraint<TypeParam> angle{"angle", DisplacementProduct<TypeParam>{x, y, false, TypeParam(7)}};
  const auto q = this->vector({1, 2, 3, 5, 0, 0, -4, 1});
  EXPECT_EQ(value(angle, 2, q).g, (1 - 3) * (-4 - 3) + (2 - 5) * (1 - 5) - 7);
  EXPECT_EQ(curvature(angle, 2, q), 2 * ((1 - 3) * (-4 - 3) + (2 - 5) * (1 - 5)));
  EXPECT_EQ(coordinates(angle, 2), (std::vector<Index>{0, 1, 2, 3, 6, 7}));
}

TYPED_TEST(ConstraintTest, QuadricWithALinearPart) {
  Matrix<TypeParam> A(2, 2);
  A << TypeParam(2), TypeParam(-1), TypeParam(-1), TypeParam(3);
  const Constraint<TypeParam> quadric{"quadric", Quadric<TypeParam>{2, A, this->vector({4, -5}), TypeParam(6)}};
  const auto q = this->vector({9, 9, 1, -2});
  EXPECT_EQ(value(quadric, 2, q).g, 2 * 1 - 2 * (-2) + 3 * 4 + 4 * 1 - 5 * (-2) + 6);
  EXPECT_EQ(curvature(quadric, 2, q), 2 * (2 * 1 - 2 * (-2) + 3 * 4));
  EXPECT_EQ(coordinates(quadric, 2), (std::vector<Index>{2, 3}));
}

TYPED_TEST(ConstraintTest, PlaneIsLinear) {
  const Constraint<TypeParam> plane{"plane", Plane<TypeParam>{3, this->vector({1, 2, -2}), TypeParam(4)}};
  const auto q = this->vector({9, 9, 9, 3, 5, 7});
  EXPECT_EQ(value(plane, 3, q).g, 3 + 10 - 14 - 4);
  EXPECT_EQ(curvature(plane, 3, q), 0);
  EXPECT_EQ(coordinates(plane, 3), (std::vector<Index>{3, 4, 5}));
}

TYPED_TEST(ConstraintTest, CurvatureIsTheSecondDifference) {
  for (const Index d : {2, 3}) {
    const Problem<TypeParam> problem = constrained_problem<TypeParam>(d);
    const auto q = this->random.vector(problem.m()), v = this->random.vector(problem.m());
    const auto expected = dense_curvature(problem, q, v);
    for (Index a = 0; a < problem.nu(); ++a)
      EXPECT_LE(magnitude(TypeParam(curvature(problem.constraints[static_cast<std::size_t>(a)], d, v) - expected[a])),
                512 * epsilon<TypeParam>())
          << a;
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
}  // namespace hbvm

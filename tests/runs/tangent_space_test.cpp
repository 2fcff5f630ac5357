#include "run/tangent_space.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "linear/product.hpp"
#include "printing.hpp"
#include "scalar/log2_of.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {
namespace {

/// Directions keep to g and the hidden constraints, to the square of how far they are followed.
TEST(TangentSpaceTest, HasABasisThatKeepsToTheConstraints) {
  const PrecisionScope scope(60);
  const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene("tethered_satellites"));
  const PhaseState start{scene.q0, scene.p0};
  TangentSpace space(scene.problem, start);
  const Mpfr small = pow(Mpfr(10), -25);
  const Matrix<Mpfr> basis = space.basis(start, small);
  ASSERT_EQ(basis.cols(), space.dimension());
  StateEvaluator<Mpfr> point(scene.problem);
  for (Index i = 0; i < basis.cols(); ++i) {
    for (Index j = 0; j <= i; ++j)
      EXPECT_LT(std::abs(approximately(Mpfr(dot(Vector<Mpfr>(basis.col(i)), Vector<Mpfr>(basis.col(j))) - (i == j)))),
                1e-20);
    const PhaseState there = space.moved(start, small * basis.col(i));
    const Vector<Mpfr> back = space.change(there, start, small);
    EXPECT_LT(log10_of(max_norm(Vector<Mpfr>(back - basis.col(i)))), -20);
    EXPECT_LT(log10_of(max_norm(Vector<Mpfr>(there.p - point.tangential(there.q, there.p)))), -50);
  }
}

/// Of a map whose eigenvalues are known, in a basis that is not square.
TEST(TangentSpaceTest, FindsMultipliers) {
  const PrecisionScope scope(30);
  Matrix<Mpfr> start = Matrix<Mpfr>::Zero(3, 2), end = Matrix<Mpfr>::Zero(3, 2);
  start(0, 0) = start(2, 1) = 1;
  end(2, 0) = 2;
  end(0, 1) = -2;
  const auto multipliers = multipliers_of(start, end);
  ASSERT_EQ(multipliers.size(), 2u);
  for (const std::complex<double>& multiplier : multipliers) {
    EXPECT_NEAR(multiplier.real(), 0, 1e-14);
    EXPECT_NEAR(std::abs(multiplier.imag()), 2, 1e-14);
  }
}

}  // namespace
}  // namespace hbvm::core

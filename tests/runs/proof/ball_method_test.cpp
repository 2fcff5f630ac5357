#include "run/proof/ball_method.hpp"

#include "method/hbvm.hpp"
#include "printing.hpp"
#include "reference/proof/holds.hpp"

namespace hbvm::core {
namespace {

void expect_held(const BallMatrix& balls, const Matrix<Mpfr>& numbers, const std::string& what) {
  ASSERT_EQ(balls.rows(), numbers.rows()) << what;
  ASSERT_EQ(balls.columns(), numbers.cols()) << what;
  for (Index i = 0; i < numbers.rows(); ++i)
    for (Index j = 0; j < numbers.cols(); ++j) {
      EXPECT_TRUE(holds(balls.at(i, j), numbers(i, j)))
          << what << " " << i << "," << j << ": " << text_of(balls.at(i, j)) << " and " << numbers(i, j);
      EXPECT_LT(radius_of(balls.at(i, j)), 1e-33) << what;
    }
}

/// Balls of 40 digits hold the coefficients with 80, and have nearly all their digits.
TEST(BallMethod, HoldsTheCoefficients) {
  for (const HbvmName name : {HbvmName{1, 1, 1}, {5, 3, 3}, {4, 3, 5}, {12, 8, 8}, {3, 2, 6}}) {
    const BallScope bits(140);
    const BallMethod balls = make_ball_method(name.k, name.s, name.r);
    const PrecisionScope digits(80);
    const Hbvm<Mpfr> method = make_hbvm<Mpfr>(name.k, name.s, name.r);
    expect_held(balls.P, method.P_s, name.text() + " P");
    expect_held(balls.I, method.I_s, name.text() + " I");
    expect_held(balls.P_hat, method.P_hat, name.text() + " P_hat");
    expect_held(balls.I_hat, method.I_hat, name.text() + " I_hat");
    expect_held(balls.X, method.X_s, name.text() + " X");
    expect_held(balls.b, method.b, name.text() + " b");
    expect_held(balls.b_hat, method.b_hat, name.text() + " b_hat");
    expect_held(balls.lambda_at_1, method.lambda_at_1, name.text() + " lambda at 1");
    EXPECT_EQ(balls.has_coefficients_of_lambda(), method.has_coefficients_of_lambda());
  }
}

}  // namespace
}  // namespace hbvm::core

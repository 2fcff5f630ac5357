#include "step/lobatto.hpp"

#include "method/order_conditions.hpp"
#include "method/runge_kutta.hpp"
#include "method/symmetry_defect.hpp"
#include "printing.hpp"
#include "step/stepping.hpp"

namespace hbvm::core {
namespace {

template <class S>
class LobattoTest : public InDigits<50> {};
TYPED_TEST_SUITE(LobattoTest, AllScalars, ScalarNames);

/// Hairer, Lubich, Wanner: tables II.1.1 and II.1.2, s = 3.
TYPED_TEST(LobattoTest, CoefficientsOfThreeStages) {
  using S = TypeParam;
  const Lobatto<S> method = make_lobatto<S>(3);
  const S sixth = S(1) / 6;
  const S A[3][3] = {{0, 0, 0}, {S(5) / 24, S(1) / 3, S(-1) / 24}, {sixth, S(2) / 3, sixth}};
  const S A_hat[3][3] = {{sixth, -sixth, 0}, {sixth, S(1) / 3, 0}, {sixth, S(5) / 6, 0}};
  for (Index i = 0; i < 3; ++i) {
    EXPECT_LE(magnitude(S(method.c[i] - S(static_cast<long>(i)) / 2)), epsilon<S>());
    for (Index j = 0; j < 3; ++j) {
      EXPECT_LE(magnitude(S(method.A(i, j) - A[i][j])), epsilon<S>()) << i << j;
      EXPECT_LE(magnitude(S(method.A_hat(i, j) - A_hat[i][j])), epsilon<S>()) << i << j;
    }
  }
}

/// IIIA has B(2s - 2), C(s), D(s - 2); IIIB B(2s - 2), C(s - 2), D(s).
TYPED_TEST(LobattoTest, CoefficientsMeetTheirConditions) {
  using S = TypeParam;
  for (const int s : {2, 4, 5, 9, 20}) {
    const Lobatto<S> method = make_lobatto<S>(s);
    const RungeKutta<S> a{method.A, method.b, method.c}, b{method.A_hat, method.b, method.c};
    const S tolerance = 4 * S(s) * epsilon<S>();
    EXPECT_LE(condition_B(a, 2 * s - 2), tolerance) << s;
    EXPECT_LE(condition_C(a, s), tolerance) << s;
    EXPECT_LE(condition_D(a, s - 2), tolerance) << s;
    EXPECT_LE(condition_C(b, s - 2), tolerance) << s;
    EXPECT_LE(condition_D(b, s), tolerance) << s;
    EXPECT_LE(symmetry_defect(a), tolerance) << s;
    EXPECT_LE(symmetry_defect(b), tolerance) << s;
    for (Index i = 0; i < s; ++i) {
      EXPECT_EQ(method.A(0, i), 0);
      EXPECT_EQ(method.A_hat(i, s - 1), 0);
      EXPECT_EQ(method.A(s - 1, i), method.b[i]);
    }
  }
}

/// Two stages are RATTLE.
TYPED_TEST(LobattoTest, OfTwoStagesIsRattle) {
  using S = TypeParam;
  for (const char* const name : {"double_pendulum", "kepler", "heavy_top"}) {
    const Assembled<S> scene = assemble<S>(load_scene(name));
    const State<S> lobatto = after("lobatto:2", scene, S(1) / 64, 20), rattle = after("rattle", scene, S(1) / 64, 20);
    EXPECT_LE(distance(lobatto.q, rattle.q), 10'000 * epsilon<S>()) << name;
    EXPECT_LE(distance(lobatto.p, rattle.p), 10'000 * epsilon<S>()) << name;
  }
}

/// The error at a fixed time falls by 2^(2s - 2), with constraints and without.
TEST(Lobatto, HasOrder2sMinus2) {
  const PrecisionScope digits(60);
  for (const char* const name : {"double_pendulum", "kepler", "bead_on_ellipsoid"}) {
    const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene(name));
    const State<Mpfr> expected = after("hbvm:16,16", scene, Mpfr(1) / 32, 8);
    for (const int s : {2, 3, 4, 5}) {
      const std::string method = "lobatto:" + std::to_string(s);
      const auto error = [&](long steps) {
        return distance(after(method, scene, Mpfr(1) / (4 * steps), steps).q, expected.q);
      };
      EXPECT_NEAR(order_of(error(16), error(32)), 2 * s - 2, 0.2) << name << " " << method;
    }
  }
}

}  // namespace
}  // namespace hbvm::core

#include "problem/regularity.hpp"

#include <cmath>
#include <numeric>

#include "printing.hpp"
#include "problem/dense.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

template <class S>
class Regularity : public InDigits<50> {
 protected:
  RandomValues<S> random{97};

  static Vector<S> vector(std::initializer_list<const char*> entries) {
    Vector<S> v(static_cast<Index>(entries.size()));
    Index i = 0;
    for (const char* entry : entries) v[i++] = literal<S>(entry);
    return v;
  }

  /// Bodies of these masses in the plane.
  static Problem<S> bodies(const std::vector<S>& masses) { return free_bodies<S>(2, masses); }
  static void hold(Problem<S>& problem, Index body, std::initializer_list<const char*> normal) {
    problem.constraints.push_back({"plane", Plane<S>{{2 * body}, vector(normal), S(0)}});
  }
  static void tie(Problem<S>& problem, Index a, Index b) {
    const Displacement<S> x{{{2 * a, S(1)}, {2 * b, S(-1)}}, {}};
    problem.constraints.push_back({"rod", Rod<S>{x, S(1)}});
  }
  static void pin(Problem<S>& problem, Index body) {
    const Displacement<S> x{{{2 * body, S(1)}}, {}};
    problem.constraints.push_back({"pin", Rod<S>{x, S(1)}});
  }

  static Independence<S> at_rest(const Problem<S>& problem, const Vector<S>& q) {
    return find_independent<S>(problem, q, Vector<S>::Zero(problem.m()));
  }
  static bool independent(const Problem<S>& problem, const Vector<S>& q) {
    const auto found = at_rest(problem, q);
    EXPECT_EQ(found.kept.size() + found.redundant.size(), problem.constraints.size());
    return found.redundant.empty();
  }
  static void expect_dependence(const Problem<S>& problem, const Vector<S>& q, Index constraint,
                                const std::vector<Index>& others) {
    const auto found = at_rest(problem, q);
    ASSERT_EQ(found.redundant.size(), 1u);
    EXPECT_EQ(found.redundant[0].constraint, constraint);
    EXPECT_EQ(found.redundant[0].others, others);
    EXPECT_EQ(found.redundant[0].bending, 0);
    std::vector<Index> kept(problem.constraints.size());
    std::iota(kept.begin(), kept.end(), Index{0});
    kept.erase(kept.begin() + constraint);
    EXPECT_EQ(found.kept, kept);
  }

  static void expect_condition(const Problem<S>& problem, const Vector<S>& q, double expected) {
    EXPECT_NEAR(gram_condition(problem, q) / expected, 1, 1e-12);
  }
};
TYPED_TEST_SUITE(Regularity, AllScalars, ScalarNames);

TYPED_TEST(Regularity, HoldsForIndependentConstraints) {
  for (const Index d : {2, 3}) {
    const auto problem = constrained_problem<TypeParam>(d);
    for (int trial = 0; trial < 5; ++trial)
      EXPECT_TRUE(this->independent(problem, this->random.vector(problem.m()))) << "dimension " << d;
  }
  const auto nothing = this->bodies({1});
  EXPECT_TRUE(this->independent(nothing, this->vector({"0", "0"})));
}

TYPED_TEST(Regularity, FindsARepeatedConstraint) {
  auto problem = constrained_problem<TypeParam>(2);
  for (const std::size_t copied : {0, 1, 2, 3, 5}) {
    auto repeated = problem;
    repeated.constraints.push_back(problem.constraints[copied]);
    this->expect_dependence(repeated, this->random.vector(problem.m()), problem.nu(), {static_cast<Index>(copied)});
  }
}

TYPED_TEST(Regularity, NamesTheConstraintsItIsACombinationOfAndNoOthers) {
  auto problem = this->bodies({3, 2});
  this->hold(problem, 1, {"1", "2"});
  this->hold(problem, 0, {"1", "0"});
  this->hold(problem, 1, {"1", "-1"});
  this->hold(problem, 0, {"1", "1"});
  auto one = problem, two = problem;
  const auto q = this->vector({"0", "0", "0", "0"});
  EXPECT_TRUE(this->independent(problem, q));
  this->hold(one, 0, {"-5", "0"});
  this->expect_dependence(one, q, 4, {1});
  this->hold(two, 0, {"3", "1/3"});
  this->expect_dependence(two, q, 4, {1, 3});
}

/// (0, 1) = (1, 1) - (1, 0), though it is orthogonal to (1, 0): these two stand best apart.
TYPED_TEST(Regularity, NamesAConstraintWhoseGradientIsOrthogonal) {
  auto problem = this->bodies({2});
  this->hold(problem, 0, {"1", "0"});
  this->hold(problem, 0, {"1", "1"});
  this->hold(problem, 0, {"0", "1"});
  this->expect_dependence(problem, this->vector({"0", "0"}), 1, {0, 2});
}

TYPED_TEST(Regularity, FindsAllOfThem) {
  auto problem = this->bodies({1, 1});
  this->hold(problem, 0, {"1", "0"});
  this->hold(problem, 1, {"1", "1/2"});
  this->hold(problem, 0, {"2", "0"});
  this->hold(problem, 0, {"4", "0"});
  const auto found = this->at_rest(problem, this->vector({"0", "0", "0", "0"}));
  EXPECT_EQ(found.kept, (std::vector<Index>{0, 1}));
  ASSERT_EQ(found.redundant.size(), 2u);
  for (const std::size_t r : {0, 1}) {
    EXPECT_EQ(found.redundant[r].constraint, static_cast<Index>(r + 2));
    EXPECT_EQ(found.redundant[r].others, (std::vector<Index>{0}));
  }
}

/// Of three directions in the plane, two of which are close, one of the close ones goes, whatever the order.
TYPED_TEST(Regularity, KeepsThoseThatStandBestApart) {
  for (const int far : {0, 1, 2}) {
    auto problem = this->bodies({1});
    for (int a = 0; a < 3; ++a) {
      if (a == far)
        this->hold(problem, 0, {"0", "1"});
      else
        this->hold(problem, 0, {"1", a == 2 || (far == 2 && a == 1) ? "1e-6" : "0"});
    }
    const auto found = this->at_rest(problem, this->vector({"0", "0"}));
    ASSERT_EQ(found.redundant.size(), 1u);
    EXPECT_NE(found.redundant[0].constraint, far);
    EXPECT_GT(found.square_of_sine, TypeParam(1) / 2);
  }
}

/// The same whatever the masses: of rods in a line one is a combination of the others, of rods at an angle none is.
TYPED_TEST(Regularity, DoesNotDependOnScales) {
  using S = TypeParam;
  for (const char* light : {"1", "1e-20", "1e20"})
    for (const char* length : {"1", "1e-100", "2^100"}) {
      auto problem = this->bodies({1, literal<S>(light), 1});
      this->tie(problem, 0, 1);
      this->tie(problem, 1, 2);
      this->tie(problem, 0, 2);
      const Vector<S> line = this->vector({"0", "0", "1", "2", "3", "6"}) * literal<S>(length),
                      bent = this->vector({"0", "0", "1", "2", "3", "5"}) * literal<S>(length);
      const auto found = this->at_rest(problem, line);
      ASSERT_EQ(found.redundant.size(), 1u) << light << " " << length;
      EXPECT_EQ(found.redundant[0].others.size(), 2u) << light << " " << length;
      EXPECT_TRUE(this->independent(problem, bent)) << light << " " << length;
    }
}

/// |x|^2 = 1 and x_1 = 1 at (1, 0). With velocity (0, v) the circle bends away from the line by 2 v^2, or the line from
/// the circle by v^2.
TYPED_TEST(Regularity, SeesTheRedundantBendAway) {
  auto problem = this->bodies({2});
  this->pin(problem, 0);
  this->hold(problem, 0, {"1", "0"});
  auto found = find_independent(problem, this->vector({"1", "0"}), this->vector({"0", "3"}));
  ASSERT_EQ(found.redundant.size(), 1u);
  EXPECT_EQ(found.redundant[0].bending, -9);
  EXPECT_LT(found.redundant[0].round_off, 200'000 * epsilon<TypeParam>());
  EXPECT_GT(found.redundant[0].round_off, epsilon<TypeParam>());
  problem.constraints = {problem.constraints[1], problem.constraints[0]};
  found = find_independent(problem, this->vector({"1", "0"}), this->vector({"0", "3"}));
  ASSERT_EQ(found.redundant.size(), 1u);
  EXPECT_EQ(found.redundant[0].bending, 18);
  // A rod twice bends alike.
  auto twice = this->bodies({2, 3});
  this->tie(twice, 0, 1);
  this->tie(twice, 1, 0);
  found = find_independent(twice, this->vector({"1", "0", "5", "7"}), this->vector({"0", "3", "2", "4"}));
  ASSERT_EQ(found.redundant.size(), 1u);
  EXPECT_LE(magnitude(found.redundant[0].bending), found.redundant[0].round_off);
}

TYPED_TEST(Regularity, TellsTheSmallestAngle) {
  using S = TypeParam;
  auto problem = this->bodies({1, 1});
  this->hold(problem, 1, {"1", "0"});
  this->hold(problem, 0, {"1", "0"});
  EXPECT_EQ(this->at_rest(problem, this->vector({"0", "0", "0", "0"})).square_of_sine, 1);
  this->hold(problem, 0, {"1", "1e-6"});
  this->hold(problem, 1, {"0", "1"});
  const auto found = this->at_rest(problem, this->vector({"0", "0", "0", "0"}));
  EXPECT_TRUE(found.redundant.empty());
  EXPECT_EQ(found.nearest, 2);
  EXPECT_EQ(found.near, (std::vector<Index>{1}));
  const S angle = literal<S>("1e-6"), exact = angle * angle / (1 + angle * angle);
  EXPECT_LE(magnitude(S(found.square_of_sine / exact - 1)), 8 * epsilon<S>());
}

/// A rod stretched between a pin and a wall it meets at a right angle.
TYPED_TEST(Regularity, DependsOnThePlace) {
  auto problem = this->bodies({2});
  this->pin(problem, 0);
  this->hold(problem, 0, {"1", "0"});
  this->expect_dependence(problem, this->vector({"1", "0"}), 1, {0});
  EXPECT_TRUE(this->independent(problem, this->vector({"3/5", "4/5"})));
}

/// Four coordinates, two pins and the rod between them: singular where all three lie on a line.
TYPED_TEST(Regularity, FailsForAStretchedLinkage) {
  auto problem = this->bodies({1, 3});
  this->pin(problem, 0);
  this->pin(problem, 1);
  this->tie(problem, 0, 1);
  this->expect_dependence(problem, this->vector({"3/5", "4/5", "-9/5", "-12/5"}), 2, {0, 1});
  EXPECT_TRUE(this->independent(problem, this->vector({"3/5", "4/5", "-9/5", "-2"})));
}

TYPED_TEST(Regularity, FailsWhereAGradientVanishes) {
  auto problem = this->bodies({1, 1});
  this->pin(problem, 0);
  this->tie(problem, 0, 1);
  this->expect_dependence(problem, this->vector({"1", "2", "1", "2"}), 1, {});
  this->expect_dependence(problem, this->vector({"0", "0", "1", "2"}), 0, {});
}

TYPED_TEST(Regularity, FailsInAFullMassMatrixToo) {
  using S = TypeParam;
  Problem<S> problem;
  problem.dimension = problem.potential.dimension = 2;
  problem.mass.add_full(mass_block<S>(2));
  problem.potential.m = 2;
  this->hold(problem, 0, {"1", "0"});
  this->hold(problem, 0, {"1/3", "2"});
  EXPECT_TRUE(this->independent(problem, this->vector({"0", "0"})));
  this->hold(problem, 0, {"1/7", "5"});
  this->expect_dependence(problem, this->vector({"0", "0"}), 2, {0, 1});
}

/// Normals at an angle of 1/10^n: dependent if that is round-off in the working precision, and not if it is more.
TYPED_TEST(Regularity, IsJudgedInTheWorkingPrecision) {
  const auto at_angle = [&](const char* angle) {
    auto problem = this->bodies({1});
    this->hold(problem, 0, {"1", "0"});
    this->hold(problem, 0, {"1", angle});
    return !this->independent(problem, this->vector({"0", "0"}));
  };
  const int carried = digits10<TypeParam>();
  EXPECT_FALSE(at_angle("1e-12"));
  EXPECT_EQ(at_angle("1e-16"), carried < 20);
  EXPECT_EQ(at_angle("1e-29"), carried < 30);
  EXPECT_EQ(at_angle("1e-46"), carried < 50);
  EXPECT_TRUE(at_angle("1e-51"));
}

TYPED_TEST(Regularity, ConditionOfOneOrNoConstraintIsOne) {
  auto problem = this->bodies({7});
  EXPECT_EQ(gram_condition(problem, this->vector({"3", "4"})), 1);
  this->pin(problem, 0);
  this->expect_condition(problem, this->vector({"3", "4"}), 1);
}

TYPED_TEST(Regularity, ConditionIsTheRatioOfTheEigenvalues) {
  // Unit normals with cosine 3/5: 1 + 3/5 and 1 - 3/5.
  auto problem = this->bodies({1});
  this->hold(problem, 0, {"1", "0"});
  this->hold(problem, 0, {"3/5", "4/5"});
  this->expect_condition(problem, this->vector({"0", "0"}), 4);
  // On bodies of mass 2 and 5: |n|^2/m, 9/2 and 1/5.
  auto apart = this->bodies({2, 5});
  this->hold(apart, 0, {"0", "3"});
  this->hold(apart, 1, {"1", "0"});
  this->expect_condition(apart, this->vector({"0", "0", "0", "0"}), 22.5);
  // A stretched chain from the origin, masses 1, steps (1, 0): gradients 2 (1, -1 and 1). Gram's matrix is 4 [[1, -1],
  // [-1, 2]], whose eigenvalues are 4 (3 -+ sqrt(5))/2.
  auto chain = this->bodies({1, 1});
  this->pin(chain, 0);
  this->tie(chain, 0, 1);
  const double root = std::sqrt(5.0);
  this->expect_condition(chain, this->vector({"1", "0", "2", "0"}), (3 + root) / (3 - root));
}

/// A stretched chain of n rods from the origin. Gram's matrix is 4 times that with 1, 2, 2, ... on the diagonal and -1
/// beside it. The eigenvalues of that are 2 - 2 cos((2 k - 1) pi/(2 n + 1)).
TYPED_TEST(Regularity, ConditionOfManyConstraints) {
  for (const Index n : {127, 128, 400}) {
    auto chain = this->bodies(std::vector<TypeParam>(n, TypeParam(1)));
    Vector<TypeParam> q = Vector<TypeParam>::Zero(2 * n);
    this->pin(chain, 0);
    for (Index i = 1; i < n; ++i) this->tie(chain, i - 1, i);
    for (Index i = 0; i < n; ++i) q[2 * i] = TypeParam(i + 1);
    const double angle = std::acos(-1.0) / static_cast<double>(2 * n + 1);
    const double expected = (1 - std::cos(static_cast<double>(2 * n - 1) * angle)) / (1 - std::cos(angle));
    EXPECT_NEAR(gram_condition(chain, q) / expected, 1, 1e-3) << n;
    // Heavier by the same factor and in another unit of length. The angles are as they were, and the first gradient is
    // as long as the others' where its body is half as heavy.
    EXPECT_GT(angle_condition(chain, q) / expected, 0.2) << n;
    EXPECT_LT(angle_condition(chain, q) / expected, 1) << n;
    EXPECT_TRUE(this->independent(chain, q)) << n;
  }
}

/// Constraints that share no body cost nothing: in a dense matrix this takes hours.
TYPED_TEST(Regularity, SeesRedundantOnesAmongThousands) {
  constexpr Index n = 3'000;
  auto pairs = this->bodies(std::vector<TypeParam>(2 * n, TypeParam(1)));
  Vector<TypeParam> q = Vector<TypeParam>::Zero(4 * n);
  for (Index i = 0; i < n; ++i) {
    this->tie(pairs, 2 * i, 2 * i + 1);
    q[4 * i] = 1;
  }
  this->tie(pairs, 2 * n - 2, 2 * n - 1);
  this->expect_dependence(pairs, q, n, {n - 1});
}

/// Normals (1, 0) and (1, a): trace 2 + a^2 and determinant a^2, which double cannot hold.
TYPED_TEST(Regularity, ConditionBeyondDouble) {
  if (digits10<TypeParam>() < 30) return;
  auto problem = this->bodies({1});
  this->hold(problem, 0, {"1", "0"});
  this->hold(problem, 0, {"1", "1e-8"});
  this->expect_condition(problem, this->vector({"0", "0"}), 4e16);
}

/// Two gradients with the cosine 1/2, whatever their lengths: eigenvalues 3/2 and 1/2.
TYPED_TEST(Regularity, ConditionOfTheAnglesDoesNotDependOnLengthsOrMasses) {
  auto problem = this->bodies({7, 1});
  this->hold(problem, 0, {"1000", "0"});
  this->hold(problem, 0, {"1/2", "sqrt(3)/2"});
  this->hold(problem, 1, {"0", "1/1000"});
  const auto q = this->vector({"0", "0", "0", "0"});
  EXPECT_NEAR(angle_condition(problem, q), 3, 1e-12);
  EXPECT_GT(gram_condition(problem, q), 1e6);
  EXPECT_EQ(angle_condition(this->bodies({1}), this->vector({"0", "0"})), 1);
}

}  // namespace
}  // namespace hbvm::core

#include "problem/redundant_constraints.hpp"

#include <utility>

#include "printing.hpp"
#include "problem/dense.hpp"
#include "problem/regularity.hpp"

namespace hbvm::core {
namespace {

/// Constraint `which` once more, at this place. (An insertion would assign to numbers that it has moved from.)
template <Scalar S>
void repeat(Problem<S>& problem, std::size_t which, std::size_t place) {
  const std::vector<Constraint<S>> before = std::exchange(problem.constraints, {});
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (i == place) problem.constraints.push_back(before[which]);
    problem.constraints.push_back(before[i]);
  }
}

template <class S>
class RedundantConstraintsTest : public InDigits<50> {
 protected:
  RandomValues<S> random{193};

  /// A problem with every constraint, and what is left when those are set aside that are redundant at q.
  struct Split {
    Problem<S> all, problem;
    Split(const Problem<S>& full, const Vector<S>& q) : all(full), problem(full) {
      set_aside(problem, find_independent<S>(full, q, Vector<S>::Zero(full.m())));
    }
  };

  static S tolerance() { return 10'000 * epsilon<S>(); }
};
TYPED_TEST_SUITE(RedundantConstraintsTest, AllScalars, ScalarNames);

TYPED_TEST(RedundantConstraintsTest, AreNoneInARegularProblem) {
  const auto problem = constrained_problem<TypeParam>(2);
  RedundantConstraints<TypeParam> redundant(problem);
  EXPECT_TRUE(redundant.empty());
  const auto q = this->random.vector(problem.m()), lambda = this->random.vector(problem.nu());
  EXPECT_EQ(redundant.multipliers(q, lambda), lambda);
  EXPECT_EQ(redundant.values(q).size(), 0);
  EXPECT_EQ(redundant.hidden(q, q).size(), 0);
}

TYPED_TEST(RedundantConstraintsTest, KeepTheirPlacesValuesAndHiddenConstraints) {
  using S = TypeParam;
  auto full = constrained_problem<S>(3);
  repeat(full, 1, 2);
  full.constraints.push_back(full.constraints[4]);
  const auto q = this->random.vector(full.m()), p = this->random.vector(full.m());
  const typename TestFixture::Split split(full, q);
  RedundantConstraints<S> redundant(split.problem);
  EXPECT_EQ(redundant.places(), (std::vector<Index>{2, full.nu() - 1}));
  EXPECT_EQ(split.problem.nu(), full.nu() - 2);
  EXPECT_EQ(redundant.name(0), "rod");
  full.constraints[2].name = "second rod";
  const typename TestFixture::Split named(full, q);
  const std::vector<std::string> names = names_of_constraints(named.problem);
  ASSERT_EQ(names.size(), full.constraints.size());
  for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(names[i], full.constraints[i].name) << i;
  const Vector<S> g = dense_constraints(full, q), hidden = times<S>(dense_gradient(full, q).transpose(),
                                                                    times(dense_inverse(dense_mass(full.mass)), p));
  const auto& values = redundant.values(q);
  const auto& rates = redundant.hidden(q, p);
  ASSERT_EQ(values.size(), 2);
  for (Index r = 0; r < 2; ++r) {
    const Index place = redundant.places()[static_cast<std::size_t>(r)];
    EXPECT_EQ(values[r], g[place]);
    EXPECT_GE(redundant.sizes()[r], magnitude(g[place]));
    EXPECT_LE(magnitude(S(rates[r] - hidden[place])), this->tolerance());
  }
}

/// A constraint times 1, 2 and 3: shares in the proportion of the factors.
TYPED_TEST(RedundantConstraintsTest, ShareTheMultipliers) {
  using S = TypeParam;
  Problem<S> full = free_bodies<S>(2, {5});
  for (const int factor : {1, 2, 3}) {
    const Vector<S> normal = (Vector<S>(2) << S(factor), S(-factor)).finished();
    full.constraints.push_back({"plane", Plane<S>{{0}, normal, S(0)}});
  }
  const Vector<S> q = Vector<S>::Zero(2), lambda = Vector<S>::Constant(1, S(28));
  const typename TestFixture::Split split(full, q);
  const Vector<S> shares = RedundantConstraints<S>(split.problem).multipliers(q, lambda);
  ASSERT_EQ(shares.size(), 3);
  for (Index a = 0; a < 3; ++a) EXPECT_LE(magnitude(S(shares[a] - 2 * (a + 1))), this->tolerance()) << a;
}

/// The same force, by multipliers without a part that exerts none. So it is grad g^T y for some y, and it is orthogonal
/// to the combinations of gradients that vanish.
TYPED_TEST(RedundantConstraintsTest, HaveMultipliersOfLeastNorm) {
  using S = TypeParam;
  for (const Index d : {2, 3}) {
    Problem<S> full = constrained_problem<S>(d);
    repeat(full, 3, 1);  // a quadric, later in the list as well
    full.constraints.push_back(full.constraints[0]);
    full.constraints.push_back(full.constraints[0]);
    const auto q = this->random.vector(full.m());
    const typename TestFixture::Split split(full, q);
    ASSERT_EQ(split.problem.nu(), full.nu() - 3);
    const auto lambda = this->random.vector(split.problem.nu());
    const Vector<S> all = RedundantConstraints<S>(split.problem).multipliers(q, lambda);
    const Vector<S> force = times(dense_gradient(split.problem, q), lambda), same = times(dense_gradient(full, q), all);
    EXPECT_LE(distance(force, same), this->tolerance());
    EXPECT_LE(magnitude(S(all[1] - all[4])), this->tolerance());
    EXPECT_LE(magnitude(S(all[0] - all[full.nu() - 1])), this->tolerance());
    EXPECT_LE(magnitude(S(all[0] - all[full.nu() - 2])), this->tolerance());
  }
}

}  // namespace
}  // namespace hbvm::core

#include "problem/constraint/registry.hpp"

#include "printing.hpp"
#include "problem/any_constraint.hpp"
#include "problem/constraint_gradient.hpp"
#include "problem/curvature.hpp"

namespace hbvm::core {
namespace {

/// What every form says of itself fits together, whatever forms there are.
template <class S>
class EveryForm : public InDigits<50> {
 protected:
  RandomValues<S> random{61};
  S tolerance = 4096 * epsilon<S>();

  /// Calls check(kind, problem) for every form, in the plane and in space.
  template <class Check>
  void each(Check check) {
    std::size_t forms = 0;
    for_each_constraint_form<S>([&]<class Form>() {
      for (const Index d : {2, 3}) {
        const auto constraint = any_constraint<Form>(d, random);
        EXPECT_TRUE(std::holds_alternative<Form>(constraint.form)) << Form::kind;
        check(std::string(Form::kind), three_bodies(d, constraint));
      }
      ++forms;
    });
    EXPECT_EQ(forms + std::tuple_size_v<ConstraintGroups<S>>, constraint_kinds().size());
    EXPECT_GE(forms, 5u);
  }
};
TYPED_TEST_SUITE(EveryForm, AllScalars, ScalarNames);

TYPED_TEST(EveryForm, HasItsGradient) {
  using S = TypeParam;
  this->each([&](const std::string& kind, const Problem<S>& problem) {
    constexpr Index lane_count = 3;
    ConstraintGradient<S> gradient(problem, lane_count);
    for (int update = 0; update < 2; ++update) {
      const Matrix<S> q = this->random.matrix(lane_count, problem.m()), one = Matrix<S>::Ones(lane_count, 1);
      Matrix<S> g(lane_count, 1), G = Matrix<S>::Zero(lane_count, problem.m());
      gradient.update(lanes(q), g);
      gradient.add_times(one, lanes(G));
      for (Index i = 0; i < lane_count; ++i) {
        const Vector<S> here = q.row(i).transpose();
        const Matrix<S> expected = dense_gradient(problem, here);
        EXPECT_LE(distance<S>(G.row(i).transpose(), expected.col(0)), this->tolerance) << kind;
        const auto at = value(problem.constraints[0], problem.dimension, here);
        EXPECT_LE(magnitude(S(g(i, 0) - at.g)), this->tolerance) << kind;
        S sum = 0;
        for (Index j = 0; j < problem.m(); ++j) sum += magnitude(expected(j, 0));
        EXPECT_LE(sum, gradient_size(problem.constraints[0], problem.dimension, here) + this->tolerance) << kind;
      }
    }
  });
}

TYPED_TEST(EveryForm, HasItsSecondDerivative) {
  using S = TypeParam;
  this->each([&](const std::string& kind, const Problem<S>& problem) {
    const Constraint<S>& constraint = problem.constraints[0];
    const Vector<S> q = this->random.vector(problem.m()), v = this->random.vector(problem.m());
    const S expected = dense_curvature(problem, q, v)[0], found = curvature(constraint, problem.dimension, q, v);
    EXPECT_LE(magnitude(S(found - expected)), this->tolerance) << kind;
    EXPECT_LE(magnitude(found), curvature_size(constraint, problem.dimension, q, v)) << kind;
    Curvature<S> second(problem, 1, 1);
    S sum = 0;
    for (const auto& entry : second.constraints()) {
      const auto& at = second.pairs()[static_cast<std::size_t>(entry.pair)];
      sum += v[at.row] * entry.value * v[at.column];
    }
    EXPECT_LE(magnitude(S(sum - expected)), this->tolerance) << kind;
  });
}

TYPED_TEST(EveryForm, NamesItsCoordinates) {
  using S = TypeParam;
  this->each([&](const std::string& kind, const Problem<S>& problem) {
    const Matrix<S> G = dense_gradient(problem, this->random.vector(problem.m()));
    const auto named = coordinates(problem.constraints[0], problem.dimension);
    EXPECT_TRUE(std::is_sorted(named.begin(), named.end())) << kind;
    for (Index j = 0; j < problem.m(); ++j) {
      const bool is_named = std::binary_search(named.begin(), named.end(), j);
      EXPECT_TRUE(is_named || magnitude(G(j, 0)) <= this->tolerance) << kind << ", " << j;
    }
  });
}

TYPED_TEST(EveryForm, RoundsToDouble) {
  using S = TypeParam;
  this->each([&](const std::string& kind, const Problem<S>& problem) {
    const Vector<S> q = this->random.vector(problem.m());
    const auto exact = value(problem.constraints[0], problem.dimension, q);
    const auto rounded = value(in_double(problem.constraints[0]), problem.dimension, in_double(q));
    EXPECT_NEAR(rounded.g, approximately(exact.g), 64 * epsilon<double>() * rounded.size) << kind;
  });
}

TEST(ConstraintKinds, AreFoundByTheirNames) {
  for (const std::string& kind : constraint_kinds()) {
    int calls = 0;
    EXPECT_TRUE(with_constraint_kind<double>(kind, [&]<class Kind>() {
      EXPECT_EQ(Kind::kind, kind);
      ++calls;
    }));
    EXPECT_EQ(calls, 1) << kind;
  }
  EXPECT_FALSE(with_constraint_kind<double>("rope", [&]<class Kind>() { ADD_FAILURE() << Kind::kind; }));
}

}  // namespace
}  // namespace hbvm::core

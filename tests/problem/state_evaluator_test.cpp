#include "problem/state_evaluator.hpp"

#include "hbvm/error.hpp"
#include "printing.hpp"
#include "problem/dense.hpp"
#include "problem/effect/input.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

template <class S>
class PointTest : public InDigits<50> {
 protected:
  RandomValues<S> random{79};

  static Vector<S> vector(std::initializer_list<const char*> entries) {
    Vector<S> v(static_cast<Index>(entries.size()));
    Index i = 0;
    for (const char* entry : entries) v[i++] = literal<S>(entry);
    return v;
  }

  static typename EffectInput<S>::Instance body(Index offset, const Matrix<S>& M) {
    typename EffectInput<S>::Instance instance;
    instance.x = {{{offset, S(1)}}, {}};
    instance.mass_matrix = M;
    instance.masses[0] = M(0, 0);
    return instance;
  }

  /// A bob of mass m on a rod from the origin, in the field -e_d.
  static Problem<S> pendulum(Index d, const S& mass, const S& square) {
    Problem<S> problem = free_bodies<S>(d, {mass});
    const Displacement<S> x{{{0, S(1)}}, {}};
    problem.constraints.push_back({"rod", Rod<S>{x, square}});
    problem.potential.terms.push_back(gravity(d, {body(0, Matrix<S>::Identity(d, d) * mass)}));
    return problem;
  }

  static EffectTerm<S> gravity(Index d, std::vector<typename EffectInput<S>::Instance> bodies) {
    EffectInput<S> input;
    input.kind = "uniform_gravity";
    input.dimension = d;
    std::vector<S> acceleration(static_cast<std::size_t>(d), S(0));
    acceleration.back() = -1;
    input.vectors.emplace("acceleration", acceleration);
    input.instances = std::move(bodies);
    return make_term(input);
  }

  /// All constraint forms, gravity and a quartic trap.
  static Problem<S> mixed(Index d) {
    Problem<S> problem = constrained_problem<S>(d);
    const Matrix<S> identity = Matrix<S>::Identity(d, d);
    std::vector<typename EffectInput<S>::Instance> bodies{body(0, identity * S(2)), body(d, mass_block<S>(d)),
                                                          body(2 * d, identity), body(3 * d, identity * (S(3) / 4))};
    problem.potential.terms.push_back(gravity(d, bodies));
    EffectInput<S> trap;
    trap.kind = "trap";
    trap.dimension = d;
    trap.numbers = {{"stiffness", S(1) / 2}, {"exponent", S(4)}};
    trap.instances = std::move(bodies);
    problem.potential.terms.push_back(make_term(trap));
    return problem;
  }
};
TYPED_TEST_SUITE(PointTest, AllScalars, ScalarNames);

TYPED_TEST(PointTest, EnergyIsKineticEnergyMinusU) {
  const auto problem = this->pendulum(2, TypeParam(2), TypeParam(9));
  StateEvaluator<TypeParam> point(problem);
  // m = 2 at height 3 with p = (4, 0): U = -6, H = 16/4 + 6
  EXPECT_EQ(point.energy(this->vector({"0", "3"}), this->vector({"4", "0"})), 10);
  EXPECT_EQ(point.energy(this->vector({"0", "-3"}), this->vector({"0", "0"})), -6);
}

TYPED_TEST(PointTest, EnergyWithAFullMassBlock) {
  Problem<TypeParam> problem;
  problem.dimension = problem.potential.dimension = problem.potential.m = 2;
  Matrix<TypeParam> M(2, 2);
  M << TypeParam(2), TypeParam(1), TypeParam(1), TypeParam(1);
  problem.mass.add_full(M);
  problem.potential.terms.push_back(this->gravity(2, {this->body(0, M)}));
  StateEvaluator<TypeParam> point(problem);
  // v = (1, 2), p = M v = (4, 3): T = 1/2 v.p = 5; U = a.M q with a = (0, -1), q = (5, 7): -(5 + 7)
  EXPECT_EQ(point.energy(this->vector({"5", "7"}), this->vector({"4", "3"})), 5 + 12);
}

TYPED_TEST(PointTest, ConstraintsAreTheirValues) {
  for (const Index d : {2, 3}) {
    const auto problem = this->mixed(d);
    StateEvaluator<TypeParam> point(problem);
    const auto q = this->random.vector(problem.m());
    EXPECT_EQ(point.constraints(q), dense_constraints(problem, q));
  }
}

TYPED_TEST(PointTest, HiddenConstraintsAreTheRatesOfTheConstraints) {
  for (const Index d : {2, 3}) {
    const auto problem = this->mixed(d);
    StateEvaluator<TypeParam> point(problem);
    const auto q = this->random.vector(problem.m()), p = this->random.vector(problem.m());
    const Matrix<TypeParam> W = dense_inverse(dense_mass(problem.mass)), G = dense_gradient(problem, q);
    const Vector<TypeParam> expected = times<TypeParam>(G.transpose(), times(W, p));
    EXPECT_LE(max_norm(Vector<TypeParam>(point.hidden_constraints(q, p) - expected)), 1'024 * epsilon<TypeParam>());
  }
}

TYPED_TEST(PointTest, TangentialMomentaFulfilTheHiddenConstraints) {
  for (const Index d : {2, 3}) {
    const auto problem = this->mixed(d);
    StateEvaluator<TypeParam> point(problem);
    for (int trial = 0; trial < 5; ++trial) {
      const auto q = this->random.vector(problem.m()), p = this->random.vector(problem.m());
      const Vector<TypeParam> tangential = point.tangential(q, p);
      const TypeParam scale = max_norm(p) + max_norm(tangential);
      // The Gram matrices of these states have condition numbers up to some 10^4.
      const TypeParam tolerance = TypeParam(1'000'000) * epsilon<TypeParam>() * scale;
      EXPECT_LE(max_norm(point.hidden_constraints(q, tangential)), tolerance);
      EXPECT_LE(max_norm(Vector<TypeParam>(point.tangential(q, tangential) - tangential)), tolerance);
      EXPECT_GT(max_norm(Vector<TypeParam>(tangential - p)), TypeParam(1) / 1'000);
    }
  }
}

TYPED_TEST(PointTest, TangentialMomentumIsTheNearest) {
  const auto problem = this->mixed(3);
  StateEvaluator<TypeParam> point(problem);
  const auto q = this->random.vector(problem.m()), p = this->random.vector(problem.m());
  const Vector<TypeParam> tangential = point.tangential(q, p),
                          other = point.tangential(q, this->random.vector(problem.m()));
  // p - tangential is normal to every tangential momentum in the metric M^-1.
  Vector<TypeParam> v(problem.m());
  problem.mass.velocity(lanes(other), lanes(v));
  TypeParam product = 0;
  for (Index i = 0; i < v.size(); ++i) product += v[i] * (p[i] - tangential[i]);
  EXPECT_LE(magnitude(product), TypeParam(1'000'000) * epsilon<TypeParam>());
}

TYPED_TEST(PointTest, ATangentialMomentumIsNotChanged) {
  const auto problem = this->pendulum(2, TypeParam(1), TypeParam(1));
  StateEvaluator<TypeParam> point(problem);
  const auto q = this->vector({"0", "-1"}), p = this->vector({"5/3", "0"});
  EXPECT_EQ(point.tangential(q, p), p);
  EXPECT_EQ(point.tangential(q, this->vector({"5/3", "7"})), p);
}

// q'' = g - 2 lambda q on a rod of length 1. From q.q'' = -|q'|^2 follows lambda = (|p|^2 + q.g) / 2. It is, below the
// pivot, (1 + 1) / 2, at rest on the side 0, above the pivot (|p|^2 - 1) / 2.
TYPED_TEST(PointTest, MultiplierOfTheSimplePendulum) {
  const auto problem = this->pendulum(2, TypeParam(1), TypeParam(1));
  StateEvaluator<TypeParam> point(problem);
  EXPECT_EQ(point.multiplier(this->vector({"0", "-1"}), this->vector({"1", "0"}))[0], 1);
  EXPECT_EQ(point.multiplier(this->vector({"1", "0"}), this->vector({"0", "0"}))[0], 0);
  EXPECT_EQ(point.multiplier(this->vector({"0", "1"}), this->vector({"3", "0"}))[0], 4);
}

/// Along p' = grad U - grad g lambda and q' = M^-1 p the hidden constraints keep their value. Their derivative, by
/// differences that are exact for what is quadratic, is 0.
TYPED_TEST(PointTest, ForcesKeepTheHiddenConstraints) {
  using S = TypeParam;
  for (const Index d : {2, 3}) {
    const Problem<S> problem = this->mixed(d);
    StateEvaluator<S> point(problem);
    const Vector<S> q = this->random.vector(problem.m()), p = this->random.vector(problem.m());
    const typename StateEvaluator<S>::Forces forces = point.forces(q, p);
    const Vector<S> rate = forces.applied + forces.constraint;
    Vector<S> v(problem.m());
    problem.mass.velocity(lanes(p), lanes(v));
    // grad g is linear in q, so that a half step each way gives d/dt (grad g^T v) = grad g(v)^T v + grad g^T M^-1 p'.
    const Vector<S> zero = Vector<S>::Zero(problem.m()), moved = point.hidden_constraints(q + v, p),
                    here = point.hidden_constraints(q, p), pushed = point.hidden_constraints(q, rate);
    for (Index a = 0; a < problem.nu(); ++a)
      EXPECT_LE(magnitude(S(moved[a] - here[a] + pushed[a])), 4096 * epsilon<S>() * (1 + magnitude(moved[a])))
          << d << " " << a;
    EXPECT_GT(max_norm(forces.constraint), S(0));
  }
}

// m q'' = m g - 2 lambda q and |q| = l give lambda = (|p|^2 / m + m q.g) / (2 l^2).
TYPED_TEST(PointTest, MultiplierOfAHeavyPendulumOfAnotherLength) {
  const auto problem = this->pendulum(2, TypeParam(4), TypeParam(4));
  StateEvaluator<TypeParam> point(problem);
  EXPECT_EQ(point.multiplier(this->vector({"0", "-2"}), this->vector({"8", "0"}))[0], 3);
}

TYPED_TEST(PointTest, MultiplierOfTheConicalPendulumIsItsDepth) {
  const auto problem = this->pendulum(3, TypeParam(1), TypeParam(1));
  StateEvaluator<TypeParam> point(problem);
  const auto q = this->vector({"1/sqrt(2)", "0", "-1/sqrt(2)"}), p = this->vector({"0", "sqrt(1/sqrt(2))", "0"});
  EXPECT_LE(magnitude(TypeParam(point.multiplier(q, p)[0] - literal<TypeParam>("1/sqrt(2)"))),
            4 * epsilon<TypeParam>());
}

TYPED_TEST(PointTest, MultiplierKeepsTheAccelerationOnTheConstraints) {
  using S = TypeParam;
  for (const Index d : {2, 3}) {
    const auto problem = this->mixed(d);
    StateEvaluator<S> point(problem);
    const auto q = this->random.vector(problem.m()), p = this->random.vector(problem.m());
    const Vector<S> lambda = point.multiplier(q, p);
    PotentialEvaluator<S> potential(problem.potential, 1);
    Matrix<S> all;
    potential.force(lanes(q), all);
    const Matrix<S> W = dense_inverse(dense_mass(problem.mass)), G = dense_gradient(problem, q);
    const Vector<S> force = Vector<S>(all.transpose()) - times(G, lambda);
    const Vector<S> second = dense_curvature(problem, q, times(W, p)) + times<S>(G.transpose(), times(W, force));
    EXPECT_LE(max_norm(second), S(100'000) * epsilon<S>() * (1 + max_norm(lambda))) << d;
  }
}

TYPED_TEST(PointTest, DependentConstraintsAreAnError) {
  auto problem = this->pendulum(2, TypeParam(1), TypeParam(1));
  problem.constraints.push_back(problem.constraints[0]);
  StateEvaluator<TypeParam> point(problem);
  const auto q = this->vector({"0", "-1"}), p = this->vector({"1", "0"});
  EXPECT_THROW(point.tangential(q, p), IntegrationError);
  EXPECT_THROW(point.multiplier(q, p), IntegrationError);
}

TYPED_TEST(PointTest, AVanishingGradientIsAnError) {
  const auto problem = this->pendulum(2, TypeParam(1), TypeParam(1));
  StateEvaluator<TypeParam> point(problem);
  const auto origin = this->vector({"0", "0"}), p = this->vector({"1", "0"});
  EXPECT_THROW(point.tangential(origin, p), IntegrationError);
  EXPECT_NO_THROW(point.tangential(this->vector({"0", "1"}), p));
}

TYPED_TEST(PointTest, NoConstraints) {
  auto problem = this->pendulum(2, TypeParam(1), TypeParam(1));
  problem.constraints.clear();
  StateEvaluator<TypeParam> point(problem);
  const auto q = this->vector({"3", "4"}), p = this->vector({"1", "2"});
  EXPECT_EQ(point.constraints(q).size(), 0);
  EXPECT_EQ(point.hidden_constraints(q, p).size(), 0);
  EXPECT_EQ(point.multiplier(q, p).size(), 0);
  EXPECT_EQ(point.tangential(q, p), p);
  EXPECT_EQ(point.energy(q, p), literal<TypeParam>("5/2+4"));
}

}  // namespace
}  // namespace hbvm::core

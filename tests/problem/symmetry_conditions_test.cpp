#include "problem/symmetry_conditions.hpp"

#include "printing.hpp"
#include "problem/dense.hpp"
#include "problem/effect/input.hpp"

namespace hbvm::core {
namespace {

using Motion = Vector<Mpfr>;  // (w, t)

/// A motion fulfils the conditions of a problem with one constraint, effect or mass matrix if and only if it changes
/// that nowhere. Derivatives along the motion at random positions tell.
class SymmetryConditions : public InDigits<50> {
 protected:
  RandomValues<Mpfr> random{97};

  static Problem<Mpfr> bodies(Index d) {
    Problem<Mpfr> problem = free_bodies<Mpfr>(d, {1, 2, 3});
    problem.blocks[2].translates = false;  // a director
    return problem;
  }

  /// Translations and rotations along the axes and some others; screws about (1, 2, 3)/4 and multiples of mixed sign.
  std::vector<Motion> motions(Index d) {
    const Index rotations = d == 2 ? 1 : 3;
    std::vector<Motion> result;
    for (Index i = 0; i < rotations + d; ++i) result.push_back(Motion::Unit(rotations + d, i));
    for (Index i = 0; i < rotations; ++i) {
      Motion about = Motion::Zero(rotations + d);  // t = -w x c
      about[d == 2 ? 0 : i] = 1;
      Vector<Mpfr> c(d);
      for (Index j = 0; j < d; ++j) c[j] = -Mpfr(j + 1) / 4;
      about.tail(d) = -turned(about, c);
      result.push_back(about);
    }
    Motion diagonal = Motion::Ones(rotations + d);
    diagonal.head(rotations).setZero();
    result.push_back(diagonal);
    diagonal[rotations] = -1;
    result.push_back(diagonal);
    if (d == 3) result.push_back((Motion(6) << 1, 1, 1, 0, 0, 0).finished());
    if (d == 3) result.push_back((Motion(6) << 1, 1, 1, 2, 2, 2).finished());
    result.push_back(random.vector(rotations + d));
    return result;
  }

  /// w x v.
  static Vector<Mpfr> turned(const Motion& motion, const Vector<Mpfr>& v) {
    if (v.size() == 2) return (Vector<Mpfr>(2) << -motion[0] * v[1], motion[0] * v[0]).finished();
    const Mpfr &a = motion[0], &b = motion[1], &c = motion[2];
    return (Vector<Mpfr>(3) << b * v[2] - c * v[1], c * v[0] - a * v[2], a * v[1] - b * v[0]).finished();
  }

  static Vector<Mpfr> moved(const Problem<Mpfr>& problem, const Motion& motion, const Vector<Mpfr>& q, bool moves) {
    const Index d = problem.dimension;
    Vector<Mpfr> change(q.size());
    for (const SpaceBlock& block : problem.blocks) {
      change.segment(block.offset, d) = turned(motion, q.segment(block.offset, d));
      if (moves && block.translates) change.segment(block.offset, d) += motion.tail(d);
    }
    return change;
  }

  bool keeps(const Problem<Mpfr>& problem, const Motion& motion) {
    Mpfr most = 0;
    PotentialEvaluator<Mpfr> potential(problem.potential, 1);
    for (int trial = 0; trial < 3; ++trial) {
      const Vector<Mpfr> q = random.vector(problem.m()), change = moved(problem, motion, q, true);
      const Matrix<Mpfr> G = dense_gradient(problem, q);
      for (Index a = 0; a < problem.nu(); ++a) raise_magnitude(most, Mpfr(G.col(a).dot(change)));
      Matrix<Mpfr> force;
      potential.force(lanes(q), force);
      raise_magnitude(most, Mpfr(force.row(0).transpose().dot(change)));
      raise_magnitude(most, Mpfr(moved(problem, motion, q, false).dot(problem.mass.momentum(q))));
    }
    return most < small();
  }

  static bool fulfils(const std::vector<UncertainRow>& rows, const Motion& motion) {
    for (const UncertainRow& row : rows) {
      Mpfr sum = 0;
      for (std::size_t i = 0; i < row.size(); ++i) sum += row[i].value * motion[static_cast<Index>(i)];
      if (magnitude(sum) > small()) return false;
    }
    return true;
  }

  static Mpfr small() { return sqrt(epsilon<Mpfr>()); }

  /// \return how many of the motions keep it
  int expect_agreement(const Problem<Mpfr>& problem, const std::string& what) {
    const auto rows = symmetry_conditions(problem, epsilon<Mpfr>());
    int kept = 0;
    for (const Motion& motion : motions(problem.dimension)) {
      EXPECT_EQ(fulfils(rows, motion), keeps(problem, motion)) << what << ": " << motion.transpose();
      if (fulfils(rows, motion)) ++kept;
    }
    return kept;
  }
};

TEST_F(SymmetryConditions, OfNothingAreNone) {
  EXPECT_TRUE(symmetry_conditions(bodies(2), epsilon<Mpfr>()).empty());
  EXPECT_TRUE(symmetry_conditions(bodies(3), epsilon<Mpfr>()).empty());
}

TEST_F(SymmetryConditions, OfConstraintsOfEveryForm) {
  for (const Index d : {2, 3}) {
    const Problem<Mpfr> all = constrained_problem<Mpfr>(d);
    int kept = 0;
    for (const auto& constraint : all.constraints) {
      Problem<Mpfr> problem = free_bodies<Mpfr>(d, {1, 1, 1, 1});
      problem.blocks[2].translates = false;
      problem.constraints = {constraint};
      kept += expect_agreement(problem, constraint.name);
    }
    EXPECT_GT(kept, 8) << d;
  }
}

TEST_F(SymmetryConditions, OfProductsWithShifts) {
  for (const Index d : {2, 3}) {
    Problem<Mpfr> problem = bodies(d);
    const Vector<Mpfr> shift = Vector<Mpfr>::Constant(d, Mpfr(1) / 4);
    const Displacement<Mpfr> x{{{0, Mpfr(1)}, {d, Mpfr(-1)}}, {}}, y{{{0, Mpfr(1)}, {d, Mpfr(1)}}, shift},
        director{{{2 * d, Mpfr(2)}}, {}}, fixed{{}, shift}, none{{{0, Mpfr(1)}, {0, Mpfr(-1)}}, shift};
    for (const auto& [a, b] : {std::pair(x, y), std::pair(x, director), std::pair(y, director), std::pair(x, fixed),
                               std::pair(director, fixed), std::pair(y, none), std::pair(y, y)}) {
      problem.constraints = {{"product", DisplacementProduct<Mpfr>{a, b, Mpfr(1)}}};
      expect_agreement(problem, "product");
    }
  }
}

TEST_F(SymmetryConditions, OfEffectsOfEverySymmetry) {
  for (const Index d : {2, 3}) {
    EffectInput<Mpfr>::Instance body, director, pair;
    body.x = {{{d, Mpfr(1)}}, Vector<Mpfr>(d)};
    for (Index j = 0; j < d; ++j) body.x.shift[j] = Mpfr(j + 1) / 4;
    director.x = {{{2 * d, Mpfr(1)}}, {}};
    pair.x = {{{0, Mpfr(1)}, {d, Mpfr(-1)}}, {}};
    for (auto* x : {&body, &director, &pair}) {
      x->mass_matrix = Matrix<Mpfr>::Identity(d, d);
      x->masses[0] = x->masses[1] = 1;
    }
    const std::vector<Mpfr> ones(static_cast<std::size_t>(d), Mpfr(1)), zeros(static_cast<std::size_t>(d), Mpfr(0));
    for (const EffectInput<Mpfr>& input : std::vector<EffectInput<Mpfr>>{
             {"trap", d, {{"stiffness", Mpfr(1)}, {"exponent", Mpfr(2)}}, {}, {body}},
             {"trap", d, {{"stiffness", Mpfr(1)}, {"exponent", Mpfr(4)}}, {}, {director}},
             {"mutual_gravity", d, {{"strength", Mpfr(1)}}, {}, {pair}},
             {"mutual_gravity", d, {{"strength", Mpfr(0)}}, {}, {body}},
             {"oblateness", d, {{"strength", Mpfr(1)}, {"radius", Mpfr(1)}, {"J2", Mpfr(1)}}, {{"axis", ones}}, {body}},
             {"uniform_gravity", d, {}, {{"acceleration", ones}}, {body, director}},
             {"uniform_gravity", d, {}, {{"acceleration", ones}}, {director}},
             {"uniform_gravity", d, {}, {{"acceleration", zeros}}, {body}}}) {
      Problem<Mpfr> problem = bodies(d);
      problem.potential.terms = {make_term(input)};
      expect_agreement(problem, input.kind);
    }
  }
}

TEST_F(SymmetryConditions, OfAMassMatrix) {
  for (const Index d : {2, 3}) {
    Matrix<Mpfr> round = Mpfr(2) * Matrix<Mpfr>::Identity(d, d), long_one = round, skew = round;
    long_one(0, 0) = 3;
    skew(0, 1) = skew(1, 0) = 1;
    for (const Matrix<Mpfr>& M : {round, long_one, skew}) {
      Problem<Mpfr> problem = bodies(d);
      problem.blocks.push_back({problem.m(), true});
      problem.mass.add_full(M);
      problem.potential.m = problem.m();
      expect_agreement(problem, "mass matrix");
    }
  }
}

/// A row's error is the round-off of the scene's numbers: of a product of two of them, twice the unit.
TEST_F(SymmetryConditions, KnowTheirRoundOff) {
  Problem<Mpfr> problem = bodies(2);
  problem.constraints = {{"rod to a point", Rod<Mpfr>{{{{0, Mpfr(1)}}, Vector<Mpfr>::Constant(2, Mpfr(3))}, Mpfr(1)}}};
  const Mpfr unit = sqrt(epsilon<Mpfr>());
  const auto rows = symmetry_conditions(problem, unit);
  ASSERT_EQ(rows.size(), 2u);
  for (const UncertainRow& row : rows) {
    EXPECT_EQ(magnitude(row[0].value), 3);
    EXPECT_GE(row[0].error, 3 * unit);
    EXPECT_LE(row[0].error, Mpfr(3) * unit * Mpfr(1.001));
  }
  EXPECT_LE(rows[0][1].error, 4 * epsilon<Mpfr>()) << "a whole weight is exact";
  EXPECT_EQ(rows[0][1].value, 1);
}

}  // namespace
}  // namespace hbvm::core

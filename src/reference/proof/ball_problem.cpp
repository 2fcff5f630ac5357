#include "ball_problem.hpp"

#include <map>

#include "hbvm/error.hpp"

namespace hbvm::core {
namespace {

std::vector<Mpfr> row(const Matrix<Mpfr>& coefficients, Index instance) {
  std::vector<Mpfr> result;
  for (Index c = 0; c < coefficients.cols(); ++c) result.push_back(coefficients(instance, c));
  return result;
}

/// A sum whose terms are believed as far as each is by itself, also where they cancel.
RealBall believed_sum(const ConstraintValue<Mpfr>& sum) {
  return exact_ball(raw(sum.g)) + (believed(sum.size) - exact_ball(raw(sum.size)));
}

BallConstraint quadratic(const Constraint<Mpfr>& constraint, Index dimension, Index m) {
  BallConstraint result;
  std::map<Index, std::map<Index, Mpfr>> second = second_derivatives(constraint, dimension);
  for (const auto& [i, row_of] : second)
    for (const auto& [j, h] : row_of) result.second.push_back({i, j, believed(h)});
  const Vector<Mpfr> origin = Vector<Mpfr>::Zero(m);
  result.at_origin = believed_sum(value(constraint, dimension, origin));
  for (const Index j : coordinates(constraint, dimension)) {
    Vector<Mpfr> unit = origin;
    unit[j] = 1;
    // g(e_j) - g(0) - H_jj / 2.
    RealBall slope = believed_sum(value(constraint, dimension, unit)) - result.at_origin;
    if (const auto curved = second[j].find(j); curved != second[j].end())
      slope -= believed(curved->second) / RealBall(2);
    result.coordinates.push_back(j);
    result.slopes.push_back(slope);
  }
  return result;
}

}  // namespace

BallForce::BallForce(const EffectTerm<Mpfr>& term, Index instance, Index dimension)
    : value(term.value, row(term.value_coefficients, instance)),
      gradient(term.gradient, row(term.gradient_coefficients, instance)),
      hessian(term.hessian, row(term.hessian_coefficients, instance)) {
  for (Index a = 0; a < term.arguments; ++a) {
    const Displacement<Mpfr>& x = term.displacement(instance, a);
    for (Index c = 0; c < dimension; ++c) {
      std::vector<BallPart>& of_input = parts.emplace_back();
      for (const auto& block : x.blocks) of_input.push_back({block.offset + c, believed(block.weight)});
      shifts.push_back(x.shift.size() > 0 ? believed(x.shift[c]) : RealBall());
    }
  }
}

BallSeries BallForce::input(std::size_t i, const std::vector<BallSeries>& q) const {
  BallSeries x(shifts[i]);
  for (const BallPart& part : parts[i]) x += q[static_cast<std::size_t>(part.coordinate)] * part.weight;
  return x;
}

std::vector<BallSeries> BallForce::inputs(const std::vector<BallSeries>& q) const {
  std::vector<BallSeries> result;
  for (std::size_t i = 0; i < parts.size(); ++i) result.push_back(input(i, q));
  return result;
}

BallProblem::BallProblem(const Problem<Mpfr>& problem) : M_(problem.m(), problem.m()), W_(problem.m(), problem.m()) {
  const Index d = problem.dimension;
  first_.resize(static_cast<std::size_t>(m()));
  end_.resize(static_cast<std::size_t>(m()));
  for (const auto& block : problem.mass.blocks()) {
    BallMatrix own(block.size, block.size), inverse;
    for (Index i = 0; i < block.size; ++i)
      for (Index j = 0; j < block.size; ++j) {
        if (block.full)
          own.set(i, j, believed(block.M(i, j)));
        else if (i == j)
          own.set(i, i, believed(block.mass));
      }
    if (!own.invert(inverse)) throw IntegrationError("the mass matrix cannot be told from a singular one");
    for (Index i = 0; i < block.size; ++i) {
      first_[static_cast<std::size_t>(block.offset + i)] = block.offset;
      end_[static_cast<std::size_t>(block.offset + i)] = block.offset + block.size;
      for (Index j = 0; j < block.size; ++j) {
        M_.set(block.offset + i, block.offset + j, own.at(i, j));
        if (block.full || i == j) W_.set(block.offset + i, block.offset + j, inverse.at(i, j));
      }
    }
  }
  for (const EffectTerm<Mpfr>& term : problem.potential.terms)
    for (Index n = 0; n < term.instances(); ++n) forces_.emplace_back(term, n, d);
  for (const Constraint<Mpfr>& constraint : problem.constraints) {
    const auto* const formula = std::get_if<FormulaConstraint<Mpfr>>(&constraint.form);
    if (formula == nullptr) {
      constraints_.push_back(quadratic(constraint, d, m()));
      continue;
    }
    BallConstraint& made = constraints_.emplace_back();
    for (const Index j : coordinates(constraint, d)) made.coordinates.push_back(j);
    made.formula.emplace(formula->term, 0, d);
  }
}

std::vector<BallSeries> BallProblem::force(const std::vector<BallSeries>& q, Index length) const {
  std::vector<BallSeries> F(q.size());
  for (const BallForce& force : forces_) {
    const std::vector<BallSeries> y = force.gradient.outputs(force.inputs(q), length);
    for (std::size_t i = 0; i < y.size(); ++i)
      for (const BallPart& part : force.parts[i]) F[static_cast<std::size_t>(part.coordinate)] += y[i] * part.weight;
  }
  return F;
}

std::vector<BallSlope> BallProblem::slopes(Index a, const std::vector<BallSeries>& q, Index length) const {
  const BallConstraint& constraint = constraints_[static_cast<std::size_t>(a)];
  std::vector<BallSlope> result;
  std::map<Index, std::size_t> place;
  for (const Index j : constraint.coordinates) {
    place.emplace(j, result.size());
    result.push_back({j, {}});
  }
  if (constraint.formula) {
    const std::vector<BallSeries> y = constraint.formula->gradient.outputs(constraint.formula->inputs(q), length);
    for (std::size_t i = 0; i < y.size(); ++i)
      for (const BallPart& part : constraint.formula->parts[i])
        result[place.at(part.coordinate)].series += y[i] * part.weight;
    return result;
  }
  for (std::size_t i = 0; i < result.size(); ++i) result[i].series = BallSeries(constraint.slopes[i]);
  for (const BallConstraint::Entry& entry : constraint.second)
    result[place.at(entry.i)].series += q[static_cast<std::size_t>(entry.j)].shortened(length) * entry.h;
  return result;
}

std::vector<RealBall> BallProblem::constraint_values(const std::vector<RealBall>& q) const {
  const std::vector<BallSeries> at = as_series(q);
  std::vector<RealBall> result;
  for (const BallConstraint& constraint : constraints_) {
    if (constraint.formula) {
      result.push_back(constraint.formula->value.outputs(constraint.formula->inputs(at), 1).front()[0]);
      continue;
    }
    RealBall g = constraint.at_origin;
    for (std::size_t i = 0; i < constraint.coordinates.size(); ++i)
      g.add_product(constraint.slopes[i], q[static_cast<std::size_t>(constraint.coordinates[i])]);
    for (const auto& [i, j, h] : constraint.second)
      g.add_product(h / RealBall(2), q[static_cast<std::size_t>(i)] * q[static_cast<std::size_t>(j)]);
    result.push_back(g);
  }
  return result;
}

RealBall BallProblem::potential_energy(const std::vector<RealBall>& q) const {
  RealBall sum;
  const std::vector<BallSeries> at = as_series(q);
  for (const BallForce& force : forces_) sum -= force.value.outputs(force.inputs(at), 1).front()[0];
  return sum;
}

BallProblem ball_problem_of(const Problem<Mpfr>& exact) {
  const PrecisionScope all(2 * Mpfr::thread_default_precision());
  const BallScope scope(significand_bits<Mpfr>());
  return BallProblem(exact);
}

std::vector<BallSeries> as_series(const std::vector<RealBall>& x) {
  std::vector<BallSeries> result;
  for (const RealBall& value : x) result.emplace_back(value);
  return result;
}

}  // namespace hbvm::core

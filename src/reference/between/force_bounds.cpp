#include "force_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "problem/driven_course.hpp"
#include "scalar/log2_of.hpp"

namespace hbvm::core {
namespace {

constexpr double nothing = -std::numeric_limits<double>::infinity();

}  // namespace

ForceBounds::ForceBounds(const Problem<Mpfr>& problem) : problem_(problem) {
  for (const EffectTerm<Mpfr>& term : problem.potential.terms)
    for (Index n = 0; n < term.instances(); ++n) add(term, n, "effect '" + term.kind + "'", false);
  for (const Constraint<Mpfr>& constraint : problem.constraints)
    if (const auto* const formula = std::get_if<FormulaConstraint<Mpfr>>(&constraint.form))
      add(formula->term, 0, "constraint " + constraint.name, true);
  for (const ForceTerm<Mpfr>& term : problem.forces)
    for (Index n = 0; n < term.instances(); ++n) {
      std::vector<const Mpfr*> coefficients;
      for (Index c = 0; c < term.force_coefficients.cols(); ++c) coefficients.push_back(&term.force_coefficients(n, c));
      pulls_.push_back({&term, n, BallProgram(term.force, 2 * term.arguments * problem.dimension, coefficients)});
    }
  for (const DrivenPoint<Mpfr>& point : problem.driven)
    courses_.emplace_back(point.course, 1, std::vector<const Mpfr*>{});
  const auto& blocks = problem.mass.blocks();
  block_of_.resize(static_cast<std::size_t>(problem.m()));
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    std::fill_n(block_of_.begin() + blocks[b].offset, blocks[b].size, b);
    inertia_.push_back(log2_of(blocks[b].full ? max_norm(blocks[b].M) : blocks[b].mass));
  }
}

void ForceBounds::add(const EffectTerm<Mpfr>& term, Index instance, std::string name, bool is_constraint) {
  std::vector<const Mpfr*> coefficients;
  for (Index c = 0; c < term.gradient_coefficients.cols(); ++c)
    coefficients.push_back(&term.gradient_coefficients(instance, c));
  forces_.push_back({&term, instance, std::move(name), is_constraint,
                     BallProgram(term.gradient, term.arguments * problem_.dimension, coefficients)});
}

void ForceBounds::start(const Vector<Mpfr>& q, const Vector<Mpfr>& p) {
  const auto& blocks = problem_.mass.blocks();
  const Index d = problem_.dimension;
  Vector<Mpfr> v(p.size());
  problem_.mass.velocity(lanes(p), lanes(v));
  const Index bodies = problem_.mass.of_bodies();
  reach_ = log2_of(max_norm(Vector<Mpfr>(q.head(bodies))));
  speed_ = log2_of(max_norm(Vector<Mpfr>(v.head(bodies))));
  momentum_.assign(blocks.size(), nothing);
  force_.assign(blocks.size(), nothing);
  for (Index j = 0; j < bodies; ++j) {
    double& size = momentum_[block_of_[static_cast<std::size_t>(j)]];
    size = std::max(size, log2_of(p[j]));
  }
  for (Force& force : forces_) {
    const Index inputs = force.term->arguments * d;
    std::vector<Mpfr> values, sizes;
    for (Index a = 0; a < force.term->arguments; ++a)
      for (const Mpfr& x : displaced(force.term->displacement(force.instance, a), d, q)) {
        values.push_back(x);
        sizes.push_back(magnitude(x));
      }
    for (Index c = 0; c < force.term->gradient_coefficients.cols(); ++c) {
      values.push_back(force.term->gradient_coefficients(force.instance, c));
      sizes.push_back(magnitude(values.back()));
    }
    const std::vector<Mpfr> found = force.term->gradient.rounding_sizes(values, sizes);
    force.log2_size = nothing;
    for (Index i = 0; i < inputs; ++i) {
      const double size = log2_of(found[static_cast<std::size_t>(i)]);
      force.log2_size = std::max(force.log2_size, size);
      if (!force.is_constraint) note_force(force.displacement(i, d), size);
    }
  }
  if (!courses_.empty()) {
    DrivenCourse<Mpfr> course(problem_, 1);
    place(course, problem_, q);
    course.set_velocities(lanes(v));
    driven_.resize(3 * d * static_cast<Index>(courses_.size()));
    const Matrix<Mpfr> now = Matrix<Mpfr>::Constant(1, 1, q[problem_.clock()]);
    for (std::size_t n = 0; n < courses_.size(); ++n)
      driven_.segment(3 * d * static_cast<Index>(n), 3 * d) =
          outputs_of(problem_.driven[n].course, Matrix<Mpfr>(1, 0), now).transpose();
  }
  for (std::size_t n = 0; n < problem_.forces.size(); ++n) {
    const ForceTerm<Mpfr>& term = problem_.forces[n];
    ForceInputs<Mpfr> inputs(term, d, 1);
    inputs.update(lanes(q), lanes(std::as_const(v)));
    for (Index i = 0; i < term.instances(); ++i) {
      std::vector<Mpfr> values, sizes;
      for (const Matrix<Mpfr>* const of : {&inputs.values(), &term.force_coefficients})
        for (Index c = 0; c < of->cols(); ++c) {
          values.push_back((*of)(i, c));
          sizes.push_back(magnitude(values.back()));
        }
      const std::vector<Mpfr> found = term.force.rounding_sizes(values, sizes);
      for (Index j = 0; j < term.acting * d; ++j)
        note_force(term.displacement(i, j / d), log2_of(found[static_cast<std::size_t>(j)]));
    }
  }
}

void ForceBounds::note_force(const Displacement<Mpfr>& of, double log2_size) {
  for (const auto& block : of.blocks) {
    if (block.offset >= problem_.mass.of_bodies()) continue;
    double& all = force_[block_of_[static_cast<std::size_t>(block.offset)]];
    // What has no finite size at a point, as a root at 0, says nothing of how large a force is.
    if (std::isfinite(log2_size)) all = std::max(all, log2_size + log2_of(block.weight));
  }
}

double ForceBounds::limit_of(const Displacement<Mpfr>& of, const std::vector<double>& scale, double log2_h) const {
  double limit = std::numeric_limits<double>::infinity();
  for (const auto& block : of.blocks)
    if (block.offset < problem_.mass.of_bodies())
      limit =
          std::min(limit, scale[block_of_[static_cast<std::size_t>(block.offset)]] - log2_of(block.weight) - log2_h);
  return limit;
}

std::vector<double> ForceBounds::scales(double log2_h) const {
  // A body at rest on which next to nothing acts has as much more as is nothing beside the motion of the others.
  std::vector<double> scale;
  const double far = std::max(reach_, speed_ + log2_h), beyond = 2 * static_cast<double>(significand_bits<Mpfr>());
  for (std::size_t b = 0; b < momentum_.size(); ++b)
    scale.push_back(std::max({momentum_[b], force_[b] + log2_h, inertia_[b] + far - log2_h - beyond}));
  return scale;
}

std::vector<double> ForceBounds::limits(std::size_t number, double log2_h) const {
  const Force& force = forces_[number];
  const Index d = problem_.dimension;
  const std::vector<double> scale = scales(log2_h);
  std::vector<double> result;
  for (Index i = 0; i < force.term->arguments * d; ++i) {
    const double limit = force.is_constraint ? force.log2_size : limit_of(force.displacement(i, d), scale, log2_h);
    result.push_back(limit + allowed_bits);
  }
  return result;
}

std::vector<double> ForceBounds::pull_limits(const Pull& pull, double log2_h) const {
  const std::vector<double> scale = scales(log2_h);
  std::vector<double> result;
  for (Index i = 0; i < pull.term->acting * problem_.dimension; ++i)
    result.push_back(limit_of(pull.term->displacement(pull.instance, i / problem_.dimension), scale, log2_h) +
                     allowed_bits);
  return result;
}

std::vector<double> ForceBounds::course_limits(std::size_t point, double log2_h) const {
  const Index d = problem_.dimension, first = 3 * d * static_cast<Index>(point);
  double far = reach_;
  for (Index j = 0; j < 3 * d; ++j)
    far = std::max(far, log2_of(driven_[first + j]) + static_cast<double>(j / d) * log2_h);
  std::vector<double> result;
  for (Index j = 0; j < 3 * d; ++j) result.push_back(far - static_cast<double>(j / d) * log2_h + allowed_bits);
  return result;
}

bool ForceBounds::fails(const std::string& name, const BallProgram& program) {
  obstacle_ = name + ": " + program.obstacle();
  return false;
}

bool ForceBounds::hold(double log2_h, const LoopOf& loop, const LoopOf& forces, const std::function<Loop()>& time) {
  for (std::size_t n = 0; n < courses_.size(); ++n)
    if (!courses_[n].is_bounded({time()}, course_limits(n, log2_h))) return fails(problem_.driven[n].name, courses_[n]);
  for (std::size_t n = 0; n < pulls_.size(); ++n) {
    std::vector<Loop> loops;
    for (Index i = 0; i < 2 * pulls_[n].term->arguments * problem_.dimension; ++i) loops.push_back(forces(n, i));
    if (!pulls_[n].program.is_bounded(loops, pull_limits(pulls_[n], log2_h)))
      return fails(pulls_[n].term->name, pulls_[n].program);
  }
  for (std::size_t f = 0; f < forces_.size(); ++f) {
    Force& force = forces_[f];
    if (force.term->constant_force) continue;
    std::vector<Loop> loops;
    for (Index i = 0; i < force.term->arguments * problem_.dimension; ++i) loops.push_back(loop(f, i));
    if (!force.program.is_bounded(loops, limits(f, log2_h))) return fails(force.name, force.program);
  }
  return true;
}

}  // namespace hbvm::core

#include "force_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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
  reach_ = log2_of(max_norm(q));
  speed_ = log2_of(max_norm(v));
  momentum_.assign(blocks.size(), nothing);
  force_.assign(blocks.size(), nothing);
  for (Index j = 0; j < p.size(); ++j) {
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
      if (force.is_constraint) continue;
      for (const auto& block : force.displacement(i, d).blocks) {
        double& all = force_[block_of_[static_cast<std::size_t>(block.offset)]];
        all = std::max(all, size + log2_of(block.weight));
      }
    }
  }
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
    double limit = force.log2_size;
    if (!force.is_constraint) {
      limit = std::numeric_limits<double>::infinity();
      for (const auto& block : force.displacement(i, d).blocks)
        limit =
            std::min(limit, scale[block_of_[static_cast<std::size_t>(block.offset)]] - log2_of(block.weight) - log2_h);
    }
    result.push_back(limit + allowed_bits);
  }
  return result;
}

bool ForceBounds::hold(double log2_h, const LoopOf& loop) {
  for (std::size_t f = 0; f < forces_.size(); ++f) {
    Force& force = forces_[f];
    if (force.term->constant_force) continue;
    std::vector<Loop> loops;
    for (Index i = 0; i < force.term->arguments * problem_.dimension; ++i) loops.push_back(loop(f, i));
    if (!force.program.is_bounded(loops, limits(f, log2_h))) {
      failed_ = f;
      return false;
    }
  }
  return true;
}

std::string ForceBounds::obstacle() const { return forces_[failed_].name + ": " + forces_[failed_].program.obstacle(); }

}  // namespace hbvm::core

#include "weak_terms.hpp"

#include <algorithm>
#include <limits>
#include <variant>

#include "hbvm/error.hpp"
#include "problem/state_evaluator.hpp"
#include "reference/program_series.hpp"
#include "reference/reference_motion.hpp"
#include "sensitivity.hpp"

namespace hbvm::core {
namespace {

constexpr double none = -std::numeric_limits<double>::infinity();

/// Of degrees above the exact one as many as a formula that is no polynomial is likely to have terms of.
constexpr int more_degrees = 6, most_degree = 60;

}  // namespace

WeakTerms::ErrorSizes::ErrorSizes() : greatest(none), least(-none), least_of_all(-none) {}

WeakTerms::WeakTerms(const Assembled<Mpfr>& scene, int log2_scale, int exact_degree)
    : scene_(scene), exact_degree_(exact_degree) {
  const Problem<Mpfr>& problem = scene.problem;
  StateEvaluator<Mpfr> point(problem);
  constexpr unsigned patterns = 4;
  for (unsigned pattern = 1; pattern <= patterns; ++pattern) {
    const Vector<Mpfr> off = kick(problem, point, log2_scale, scene.q0, scene.p0, pattern).q;
    places_.emplace_back(scene.q0 + off / 64);
    directions_.push_back(off);
    raise_to(size_, max_norm(off));
  }
  for (const EffectTerm<Mpfr>& term : problem.potential.terms)
    for (Index i = 0; i < term.instances(); ++i)
      if (term.symmetry.acts[static_cast<std::size_t>(i)]) expand(term, i, of_U_);
  for (const Constraint<Mpfr>& constraint : problem.constraints)
    if (const auto* formula = std::get_if<FormulaConstraint<Mpfr>>(&constraint.form)) {
      ErrorSizes of_this;
      expand(formula->term, 0, of_this);
      of_g_.told = std::max(of_g_.told, of_this.bits().told);
      of_g_.all = std::max(of_g_.all, of_this.bits().all);
    }
}

void WeakTerms::expand(const EffectTerm<Mpfr>& term, Index instance, ErrorSizes& sizes) {
  const Index d = scene_.problem.dimension, inputs = term.arguments * d;
  const auto order =
      static_cast<Index>(std::clamp(std::max(term.degree, exact_degree_ + more_degrees), 1, most_degree));
  std::vector<const Mpfr*> coefficients;
  for (Index i = 0; i < term.value_coefficients.cols(); ++i)
    coefficients.push_back(&term.value_coefficients(instance, i));
  const auto inputs_at = [&](const Vector<Mpfr>& q, bool moving) {
    Vector<Mpfr> x(inputs);
    for (Index a = 0; a < term.arguments; ++a) {
      Displacement<Mpfr> displacement = term.displacement(instance, a);
      if (moving) displacement.shift = Vector<Mpfr>();
      x.segment(a * d, d) = displaced(displacement, d, q);
    }
    return x;
  };
  const double noise = -static_cast<double>(significand_bits<Mpfr>()) * 19 / 20;
  const auto along = [&](const Vector<Mpfr>& x, const Vector<Mpfr>& dx) {
    double greatest = none, inexact = none;
    try {
      ProgramSeries series(term.value, inputs, coefficients, order);
      for (Index n = 0; n <= order; ++n) {
        for (Index i = 0; i < inputs; ++i) series.input(i, n) = n == 0 ? x[i] : n == 1 ? dx[i] : Mpfr(0);
        series.advance(n);
        if (n == 0) continue;
        const double size = log2_of(series.output(0, n));
        if (!(size < -none)) return;
        greatest = std::max(greatest, size);
        if (n > exact_degree_) inexact = std::max(inexact, size);
      }
    } catch (const IntegrationError&) {
      return;  // no series here, where the motion does not lead
    }
    sizes.greatest = std::max(sizes.greatest, greatest);
    if (inexact == none) return;
    sizes.least_of_all = std::min(sizes.least_of_all, inexact);
    if (inexact >= greatest + noise) sizes.least = std::min(sizes.least, inexact);
  };
  for (std::size_t n = 0; n < places_.size(); ++n) along(inputs_at(places_[n], false), inputs_at(directions_[n], true));
  // Each input by itself, from where it is: a motion may lead along one alone.
  constexpr Index most_inputs = 24;
  for (Index i = 0; i < std::min(inputs, most_inputs); ++i)
    along(inputs_at(scene_.q0, false), Vector<Mpfr>(size_ * Vector<Mpfr>::Unit(inputs, i)));
}

}  // namespace hbvm::core

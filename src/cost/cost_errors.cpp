#include "cost/cost_errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hbvm/error.hpp"
#include "problem/state_evaluator.hpp"
#include "reference/reference_motion.hpp"
#include "scalar/precision.hpp"

namespace hbvm::core {
namespace {

constexpr std::string_view quantity_names[] = {"q", "p", "lambda", "all"};

}  // namespace

CostQuantity parse_cost_quantity(std::string_view name) {
  for (const CostQuantity quantity : {CostQuantity::q, CostQuantity::p, CostQuantity::lambda, CostQuantity::all})
    if (name == name_of(quantity)) return quantity;
  throw InputError("--quantity '" + std::string(name) + "': use q, p, lambda or all");
}

std::string_view name_of(CostQuantity quantity) { return quantity_names[static_cast<int>(quantity)]; }

double CostErrors::of(CostQuantity quantity) const {
  switch (quantity) {
    case CostQuantity::q:
      return q;
    case CostQuantity::p:
      return p;
    case CostQuantity::lambda:
      return lambda;
    case CostQuantity::all:
      break;
  }
  const double both = std::max(q, p);
  return std::isnan(lambda) ? both : std::max(both, lambda);
}

CostJudge::CostJudge(const Scene& scene, const ReferenceState& state, int digits) : digits_(digits) {
  constexpr unsigned guard = 10;
  working_digits_ = std::max(static_cast<unsigned>(digits) + guard, Precision::min_digits);
  const PrecisionScope scope(working_digits_);
  const Assembled<Mpfr> assembled = assemble<Mpfr>(scene);
  StateEvaluator<Mpfr> point(assembled.problem);
  const Index dimension = assembled.problem.dimension;
  const Index bodies = assembled.problem.mass.of_bodies();
  q_ = component(state.q, assembled.q0.head(bodies), dimension, resolution_.q);
  p_ = component(state.p, assembled.p0.head(bodies), dimension, resolution_.p);
  lambda_ = component(state.lambda, point.multiplier(assembled.q0, assembled.p0), 1, resolution_.lambda);
}

CostJudge::Component CostJudge::component(const std::vector<std::string>& texts, const Vector<Mpfr>& start, Index group,
                                          double& resolution) {
  const auto size = static_cast<Index>(texts.size());
  if (size != start.size())
    throw InputError("the reference has " + std::to_string(size) + " numbers where the scene " + "has " +
                     std::to_string(start.size()));
  Component result{Vector<Mpfr>(size), Vector<Mpfr>(size)};
  for (Index i = 0; i < size; ++i) result.exact[i] = Mpfr(texts[static_cast<std::size_t>(i)]);
  resolution = std::numeric_limits<double>::quiet_NaN();
  if (size == 0) return result;
  const Mpfr leading = max_norm(result.exact);
  // Of what is at rest at the origin in the end, what it was at the start.
  Mpfr greatest = leading == 0 ? max_norm(start) : leading;
  if (greatest == 0) greatest = 1;
  Mpfr least = greatest;
  for (Index first = 0; first < size; first += group) {
    Mpfr scale = 0;
    const Index end = std::min(first + group, size);
    for (Index i = first; i < end; ++i) raise_to(scale, magnitude(result.exact[i]));
    if (scale == 0) scale = greatest;
    least = std::min(least, scale);
    for (Index i = first; i < end; ++i) result.scale[i] = scale;
  }
  resolution = (leading == 0 ? double{0} : std::ceil(log10_of(leading)) - log10_of(least)) - digits_;
  return result;
}

template <Scalar S>
double CostJudge::error(const Component& component, const Vector<S>& found, double resolution) const {
  if (component.exact.size() == 0) return std::numeric_limits<double>::quiet_NaN();
  Mpfr greatest = 0;
  for (Index i = 0; i < component.exact.size(); ++i) {
    const Mpfr x = rounded_to<Mpfr>(raw(exactly(found[i])));
    raise_to(greatest, Mpfr(magnitude(Mpfr(x - component.exact[i])) / component.scale[i]));
  }
  if (!is_finite(greatest)) return std::numeric_limits<double>::infinity();
  return greatest == 0 ? resolution : std::max(resolution, log10_of(greatest));
}

template <Scalar S>
CostErrors CostJudge::errors(const Vector<S>& q, const Vector<S>& p, const Vector<S>& lambda) const {
  const PrecisionScope scope(std::max(working_digits_, static_cast<unsigned>(digits10<S>())));
  return {error(q_, q, resolution_.q), error(p_, p, resolution_.p), error(lambda_, lambda, resolution_.lambda)};
}

#define HBVM_DEFINE(S) \
  template CostErrors CostJudge::errors<S>(const Vector<S>&, const Vector<S>&, const Vector<S>&) const;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

#include "integrate/coefficient_decay.hpp"

#include "scalar/in_place.hpp"

namespace hbvm::core {

template <Scalar S>
CoefficientDecay<S>::CoefficientDecay(const Problem<S>& problem, int s, const S& step)
    : problem_(problem),
      dimension_(problem.dimension),
      s_(s),
      h_(step),
      bodies_(static_cast<std::size_t>(problem.mass.of_bodies() / problem.dimension)),
      before_(Vector<S>::Zero(problem.m())) {
  using std::sqrt;
  for (int j = 0; j <= s; ++j) P_at_1_.push_back(sqrt(S(2 * j + 1)));
}

template <Scalar S>
void CoefficientDecay<S>::observe(const StepResult<S>& step, const State<S>& end) {
  if (!step.unknowns) return;
  const StageUnknowns<S>& x = *step.unknowns;
  Index offset = 0;
  for (Body& body : bodies_) {
    set_zero(norm_);
    set_zero(sum_);
    for (Index i = 0; i < s_; ++i) {
      set_zero(size_);
      for (Index j = offset; j < offset + dimension_; ++j) raise_magnitude(size_, x.gamma(i, j));
      if (i == 0)
        raise_magnitude(body.mean, size_);
      else
        set_sum(sum_, sum_, size_);
    }
    set_zero(size_);
    for (Index j = offset; j < offset + dimension_; ++j) {
      raise_magnitude(body.force, x.psi(0, j));
      if (step.reversed)
        set_negative(rest_, end.p[j]);
      else
        set(rest_, end.p[j]);
      set_difference(rest_, rest_, x.gamma(0, j));
      for (Index i = 1; i < s_; ++i) subtract_product(rest_, P_at_1_[static_cast<std::size_t>(i)], x.gamma(i, j), t_);
      if (s_ > 1) {
        raise_magnitude(size_, rest_);
        continue;
      }
      raise_magnitude(sum_, rest_);
      if (has_before_) {
        set_difference(t_, rest_, before_[j]);
        raise_magnitude(size_, t_);
      }
      set(before_[j], rest_);
    }
    raise_magnitude(body.neglected, size_);
    raise_magnitude(body.varying, sum_);
    offset += dimension_;
  }
  has_before_ = true;
}

template <Scalar S>
typename CoefficientDecay<S>::Worst CoefficientDecay<S>::worst(const Vector<S>& q) const {
  Worst worst;
  const Vector<S> weighted = problem_.mass.momentum(q);
  Index offset = 0;
  for (const Body& body : bodies_) {
    const S neglected = s_ > 1 ? S(body.neglected / P_at_1_.back()) : body.neglected;
    S position = 0;
    for (Index j = offset; j < offset + dimension_; ++j) raise_magnitude(position, weighted[j]);
    const S round_off = S(1024) * epsilon<S>() * S(body.mean + magnitude(h_) * body.force + position / magnitude(h_));
    const S all = body.varying + round_off + (s_ > 1 ? neglected : S(0));
    const double ratio = neglected == 0 ? 0 : approximately(S(neglected / all));
    if (!(ratio <= worst.ratio)) worst = {ratio, offset};
    offset += dimension_;
  }
  return worst;
}

#define HBVM_DEFINE(S) template class CoefficientDecay<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

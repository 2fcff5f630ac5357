#include "hbvm/integrate/hidden_cosines.hpp"

#include <algorithm>

#include "hbvm/scalar/in_place.hpp"

namespace hbvm {

template <Scalar S>
HiddenCosines<S>::HiddenCosines(const Problem<S>& problem, long steps) : dimension_(problem.dimension), steps_(steps) {
  const ConstraintGradient<S> gradient(problem, 1);
  of_.resize(static_cast<std::size_t>(problem.nu()));
  for (Index a = 0; a < problem.nu(); ++a) {
    const auto& pattern = gradient.pattern(a);
    std::vector<Part>& parts = of_[static_cast<std::size_t>(a)].parts;
    Index column = pattern.first;
    for (const Index coordinate : pattern.coordinates) {
      const Index body = coordinate / dimension_ * dimension_;
      if (parts.empty() || parts.back().coordinate != body) parts.push_back({column, 0, body});
      ++parts.back().count;
      ++column;
    }
  }
}

template <Scalar S>
void HiddenCosines<S>::observe(ConstraintGradient<S>& gradient, const Vector<S>& v, const Snapshot<S>& snapshot) {
  using std::sqrt;
  const auto quarter = static_cast<std::size_t>(std::min(3L, snapshot.n * 4 / std::max(1L, steps_)));
  Index a = 0;
  for (OfConstraint& c : of_) {
    raise_magnitude(c.lambda, snapshot.lambda[a]);
    gradient.transposed_times(a++, lanes(v), &hidden_);
    set_zero(speed_);
    for (const Part& part : c.parts) {
      set_zero(gradient_square_);
      set_zero(speed_square_);
      for (Index j = 0; j < part.count; ++j) {
        const S& g = gradient.values()(0, part.first + j);
        add_product(gradient_square_, g, g, t_);
      }
      for (Index j = 0; j < dimension_; ++j)
        add_product(speed_square_, v[part.coordinate + j], v[part.coordinate + j], t_);
      set_product(t_, gradient_square_, speed_square_);
      if (t_ > 0) speed_ += S(sqrt(t_));
    }
    raise_magnitude(c.speed, speed_);
    raise_magnitude(c.hidden[quarter], hidden_);
    if (!exceeds(hidden_, c.greatest)) continue;
    set_zero(c.greatest);
    raise_magnitude(c.greatest, hidden_);
    set(c.t, snapshot.t);
  }
}

template <Scalar S>
S HiddenCosines<S>::cosine(const OfConstraint& c, const S& hidden) const {
  return hidden == 0 ? S(0) : S(hidden / c.speed);
}

template <Scalar S>
typename HiddenCosines<S>::Worst HiddenCosines<S>::worst() const {
  Worst worst;
  for (std::size_t a = 0; a < of_.size(); ++a) {
    const S found = cosine(of_[a], of_[a].greatest);
    if (found > worst.cosine) worst = {found, static_cast<Index>(a), of_[a].t};
  }
  return worst;
}

template <Scalar S>
typename HiddenCosines<S>::Growth HiddenCosines<S>::growth(const S& least) const {
  Growth growth;
  for (std::size_t a = 0; a < of_.size(); ++a) {
    const auto& hidden = of_[a].hidden;
    if (!std::is_sorted(hidden.begin(), hidden.end()) || !(cosine(of_[a], hidden[3]) > least) || hidden[0] == 0)
      continue;
    const double factor = approximately(S(hidden[3] / hidden[0]));
    if (factor > growth.factor) growth = {factor, static_cast<Index>(a)};
  }
  return growth;
}

template <Scalar S>
S HiddenCosines<S>::power() const {
  S sum = 0;
  for (const OfConstraint& c : of_) sum += c.lambda * c.speed;
  return sum;
}

#define HBVM_DEFINE(S) template class HiddenCosines<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm

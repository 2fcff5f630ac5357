#include "integrate/hidden_cosines.hpp"

#include <algorithm>
#include <numeric>

#include "scalar/in_place.hpp"

namespace hbvm::core {
namespace {

/// Of a body.
template <Scalar S>
const S& mass_of(const typename MassMatrix<S>::Block& block) {
  // The position of a rigid body stands before its directors.
  return block.full ? block.M(0, 0) : block.mass;
}

}  // namespace

template <Scalar S>
HiddenCosines<S>::HiddenCosines(const Problem<S>& problem, long steps)
    : problem_(problem), dimension_(problem.dimension), steps_(steps) {
  const ConstraintGradient<S> gradient(problem, 1);
  of_.resize(static_cast<std::size_t>(problem.nu()));
  for (Index a = 0; a < problem.nu(); ++a) {
    const auto& pattern = gradient.pattern(a);
    std::vector<Part>& parts = of_[static_cast<std::size_t>(a)].parts;
    Index column = pattern.first;
    for (const Index coordinate : pattern.coordinates) {
      if (coordinate >= problem.mass.of_bodies()) continue;
      const Index body = coordinate / dimension_ * dimension_;
      if (parts.empty() || parts.back().coordinate != body) parts.push_back({column, 0, body});
      ++parts.back().count;
      ++column;
    }
  }
  join();
}

/// Finds the mechanisms: bodies that constraints join, directly or by others.
template <Scalar S>
void HiddenCosines<S>::join() {
  const auto& blocks = problem_.mass.blocks();
  body_of_.resize(static_cast<std::size_t>(problem_.m()));
  for (std::size_t b = 0; b < blocks.size(); ++b) std::fill_n(body_of_.begin() + blocks[b].offset, blocks[b].size, b);
  mechanism_.resize(blocks.size());
  std::iota(mechanism_.begin(), mechanism_.end(), std::size_t{0});
  const auto of = [&](Index coordinate) {
    std::size_t body = body_of_[static_cast<std::size_t>(coordinate)];
    while (mechanism_[body] != body) body = mechanism_[body] = mechanism_[mechanism_[body]];
    return body;
  };
  for (const OfConstraint& c : of_)
    for (const Part& part : c.parts) mechanism_[of(part.coordinate)] = of(c.parts.front().coordinate);
  for (std::size_t b = 0; b < blocks.size(); ++b) mechanism_[b] = of(blocks[b].offset);
  for (OfConstraint& c : of_)
    if (!c.parts.empty()) c.mechanism = of(c.parts.front().coordinate);
  squares_.assign(blocks.size(), S(0));
}

template <Scalar S>
void HiddenCosines<S>::measure(ConstraintGradient<S>& gradient, Index a, OfConstraint& c) {
  using std::sqrt;
  const auto& pattern = gradient.pattern(a);
  const auto& weighted = gradient.weighted_pattern(a);
  const auto& blocks = problem_.mass.blocks();
  set_zero(c.reach);
  S all = 0, of_body = 0;
  const auto moving = static_cast<std::size_t>(
      std::ranges::lower_bound(pattern.coordinates, problem_.mass.of_bodies()) - pattern.coordinates.begin());
  for (std::size_t i = 0; i < moving; ++i) {
    const Index coordinate = pattern.coordinates[i];
    const std::size_t body = body_of_[static_cast<std::size_t>(coordinate)];
    add_product(of_body, gradient.values()(0, pattern.first + static_cast<Index>(i)),
                gradient.weighted_values()(0, weighted.column(coordinate)), t_);
    const bool last = i + 1 == moving || body_of_[static_cast<std::size_t>(pattern.coordinates[i + 1])] != body;
    if (!last) continue;
    c.reach += S(sqrt(S(of_body * mass_of<S>(blocks[body]))));
    all += of_body;
    set_zero(of_body);
  }
  c.length = sqrt(all);
}

template <Scalar S>
void HiddenCosines<S>::observe(ConstraintGradient<S>& gradient, const Vector<S>& v, const Snapshot<S>& snapshot) {
  using std::sqrt;
  const auto quarter = static_cast<std::size_t>(std::min(3L, snapshot.n * 4 / std::max(1L, steps_)));
  const auto& blocks = problem_.mass.blocks();
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    set_zero(speed_square_);
    for (Index j = blocks[b].offset; j < blocks[b].offset + blocks[b].size; ++j)
      add_product(speed_square_, snapshot.p[j], v[j], t_);
    set_quotient(t_, speed_square_, mass_of<S>(blocks[b]));
    raise_magnitude(squares_[mechanism_[b]], t_);
  }
  Index a = 0;
  for (OfConstraint& c : of_) {
    const Index constraint = a++;
    raise_magnitude(c.lambda, snapshot.lambda[constraint]);
    gradient.transposed_times(constraint, lanes(v), &hidden_);
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
    if (snapshot.n == 0) measure(gradient, constraint, c);
    if (!exceeds(hidden_, c.greatest)) continue;
    if (snapshot.n > 0) measure(gradient, constraint, c);
    set_zero(c.greatest);
    raise_magnitude(c.greatest, hidden_);
    set(c.t, snapshot.t);
  }
}

template <Scalar S>
S HiddenCosines<S>::cosine(const OfConstraint& c, const S& hidden) const {
  using std::sqrt;
  if (hidden == 0) return 0;
  const S of_mechanism = c.reach * S(sqrt(squares_[c.mechanism]));
  return hidden / (of_mechanism > c.speed ? of_mechanism : c.speed);
}

template <Scalar S>
typename HiddenCosines<S>::Worst HiddenCosines<S>::worst(const S& step, const S& rounding) const {
  Worst worst;
  S force = 0;
  for (const OfConstraint& c : of_) force += c.lambda * c.length;
  for (std::size_t a = 0; a < of_.size(); ++a) {
    const OfConstraint& c = of_[a];
    if (!(c.greatest > rounding * step * force * c.length)) continue;
    const S found = cosine(c, c.greatest);
    if (found > worst.cosine) worst = {found, static_cast<Index>(a), c.t};
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

}  // namespace hbvm::core

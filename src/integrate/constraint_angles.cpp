#include "integrate/constraint_angles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scalar/in_place.hpp"

namespace hbvm::core {
namespace {

/// 1/sin^2 up to which a factorisation in double is right to three digits: its error is some 1/sin^2 epsilon.
constexpr double trusted = 1LL << 40;

}  // namespace

template <Scalar S>
ConstraintAngles<S>::ConstraintAngles(const Problem<S>& problem) : nu_(problem.nu()) {
  const ConstraintGradient<S> gradient(problem, 1);
  for (const auto& pair : gradient.couplings())
    if (pair.a >= pair.b) pairs_.emplace_back(pair.a, pair.b);
  order_ = order_for_band(nu_, pairs_);
  inverse_.resize(nu_, order_.half_bandwidth);
  const auto count = static_cast<std::size_t>(nu_);
  squares_.assign(count, S(0));
  squares_before_ = lengths_ = squares_;
  cosines_.assign(pairs_.size(), S(0));
  angles_.assign(count, 1);
  angles_before_ = angles_;
}

template <Scalar S>
void ConstraintAngles<S>::set_up(ConstraintGradient<S>& gradient) {
  using std::sqrt;
  std::size_t n = 0;
  for (const auto& pair : gradient.couplings()) {
    if (pair.a < pair.b) continue;
    gradient.coupling(pair, gradient, &cosines_[n++]);
    if (pair.a == pair.b) set(squares_[static_cast<std::size_t>(pair.a)], cosines_[n - 1]);
  }
  for (std::size_t a = 0; a < squares_.size(); ++a) lengths_[a] = sqrt(squares_[a]);
  for (n = 0; n < pairs_.size(); ++n) {
    const auto [a, b] = pairs_[n];
    if (a == b) {
      cosines_[n] = 1;
      continue;
    }
    set_product(product_, lengths_[static_cast<std::size_t>(a)], lengths_[static_cast<std::size_t>(b)]);
    set_quotient(cosines_[n], cosines_[n], product_);
  }
}

template <Scalar S>
bool ConstraintAngles<S>::find_angles() {
  const auto find = [&]<class T>(InverseDiagonal<T>& inverse, double limit) {
    inverse.set_zero();
    for (std::size_t n = 0; n < pairs_.size(); ++n) {
      const auto [low, high] = std::minmax({place(pairs_[n].first), place(pairs_[n].second)});
      if constexpr (std::same_as<T, S>)
        set(inverse.entry(high, low), cosines_[n]);
      else
        inverse.entry(high, low) = approximately(cosines_[n]);
    }
    if (!inverse.compute()) return false;
    bool within = true;
    for (Index a = 0; a < nu_; ++a) {
      const double angle = approximately(inverse[place(a)]);
      angles_[static_cast<std::size_t>(a)] = angle;
      within = within && angle <= limit && angle > 0;
    }
    return within;
  };
  if constexpr (std::same_as<S, double>) {
    return find(inverse_, std::numeric_limits<double>::max());
  } else {
    if (find(inverse_, trusted)) return true;
    if (precise_.size() != nu_) precise_.resize(nu_, order_.half_bandwidth);
    return find(precise_, std::numeric_limits<double>::max());
  }
}

template <Scalar S>
void ConstraintAngles<S>::see_change(double square, Index constraint, bool of_length, const S& t) {
  const double factor = std::sqrt(square < 1 ? 1 / square : square);
  if (!(factor > change_.factor)) return;
  change_.factor = factor;
  change_.constraint = constraint;
  change_.of_length = of_length;
  set(change_.t, t);
}

template <Scalar S>
void ConstraintAngles<S>::observe(ConstraintGradient<S>& gradient, const Snapshot<S>& snapshot) {
  if (nu_ == 0) return;
  set_up(gradient);
  const bool known = find_angles();
  double closest = known ? 0 : std::numeric_limits<double>::infinity();
  for (Index a = 0; a < nu_; ++a) {
    const auto i = static_cast<std::size_t>(a);
    if (known) raise_to(closest, angles_[i]);
    if (snapshot.n == 0) continue;
    if (known && known_before_) see_change(angles_[i] / angles_before_[i], a, false, snapshot.t);
    set_quotient(product_, squares_[i], squares_before_[i]);
    see_change(approximately(product_), a, true, snapshot.t);
  }
  if (closest > closest_) {
    closest_ = closest;
    closest_q_ = snapshot.q;
    set(closest_t_, snapshot.t);
  }
  std::swap(squares_, squares_before_);
  if (known) std::swap(angles_, angles_before_);
  known_before_ = known_before_ || known;
}

#define HBVM_DEFINE(S) template class ConstraintAngles<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

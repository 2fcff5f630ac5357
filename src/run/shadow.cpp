#include "run/shadow.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "run_beside.hpp"
#include "scalar/text.hpp"

namespace hbvm::core {
namespace {

/// Sees the shadow's mesh points.
template <Scalar S>
class Comparison final : public Observer<Mpfr> {
 public:
  Comparison(const Matrix<S>& states, long every, long steps)
      : states_(states), every_(every), steps_(steps), components_(static_cast<std::size_t>(states.rows())) {}

  void observe(const Snapshot<Mpfr>& snapshot) override {
    const bool last = snapshot.n == steps_;
    Mpfr off[2] = {0, 0}, size[2] = {0, 0};  // of q, of p
    const Index m = states_.rows() / 2, column = last ? states_.cols() - 1 : snapshot.n / every_;
    const bool compared = last || snapshot.n % every_ == 0;
    for (Index i = 0; i < 2 * m; ++i) {
      Component& c = components_[static_cast<std::size_t>(i)];
      const Mpfr& x = i < m ? snapshot.q[i] : snapshot.p[i - m];
      raise_magnitude(c.size, x);
      if (!compared) continue;
      const Mpfr shadowed = rounded_to<Mpfr>(raw(exactly(states_(i, column))));
      raise_magnitude(c.size, shadowed);
      c.at_end = magnitude(Mpfr(shadowed - x));
      raise_to(off[i / m], c.at_end);
      raise_to(size[i / m], c.size);
      if (!(c.at_end > c.greatest)) continue;
      c.greatest = c.at_end;
      c.t = snapshot.t;
    }
    for (const std::size_t part : {0u, 1u})
      if (!gone_t_ && size[part] > 0 && off[part] >= size[part]) gone_t_ = approximately(snapshot.t);
  }

  void report(Shadow& shadow, double all) const {
    const auto m = components_.size() / 2;
    shadow.gone_t = gone_t_;
    shadow.worst.digits = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 2 * m; ++i) {
      const Component& c = components_[i];
      (i < m ? shadow.q : shadow.p).push_back(digits(c.at_end, c.size, all));
      const double least = digits(c.greatest, c.size, all);
      if (least < shadow.worst.digits)
        shadow.worst = {(i < m ? "q_" : "p_") + std::to_string(i % m + 1), to_scientific(c.t, 4), least};
    }
  }

 private:
  struct Component {
    Mpfr size = 0, at_end = 0, greatest = 0, t = 0;
  };
  static double digits(const Mpfr& difference, const Mpfr& size, double all) {
    if (difference == 0) return all;
    const double lost = approximately(Mpfr(log10(Mpfr(difference / size))));
    return lost < 0 ? -lost : 0;
  }

  const Matrix<S>& states_;
  long every_, steps_;
  std::vector<Component> components_;
  std::optional<double> gone_t_;
};

}  // namespace

template <Scalar S>
ShadowedRun<S>::ShadowedRun(Index m, long steps, long numbers)
    : steps_(steps), every_(1 + steps / std::max(1L, numbers / (2 * m))) {
  states_ = Matrix<S>::Zero(2 * m, steps / every_ + (steps % every_ == 0 ? 1 : 2));
}

template <Scalar S>
void ShadowedRun<S>::observe(const Snapshot<S>& snapshot) {
  const bool last = snapshot.n == steps_;
  if (!last && snapshot.n % every_ != 0) return;
  const Index m = states_.rows() / 2, column = last ? states_.cols() - 1 : snapshot.n / every_;
  for (Index i = 0; i < m; ++i) {
    states_(i, column) = snapshot.q[i];
    states_(m + i, column) = snapshot.p[i];
  }
}

template <Scalar S>
Shadow ShadowedRun<S>::compare(const RunRequest& request, const Method& method,
                               const std::optional<State<S>>& start) const {
  using std::log10;
  const double all = significand_bits<S>() * log10(double{2});
  const unsigned digits = digits_of_a_run_beside<S>();
  const PrecisionScope more(digits);
  Shadow shadow;
  shadow.precision = "mpfr:" + std::to_string(digits);
  shadow.every = every_;
  try {
    Comparison<S> comparison(states_, every_, steps_);
    run_beside(request, method, start, {&comparison});
    comparison.report(shadow, all);
  } catch (const Error& error) {
    shadow.failure = error.what();
  }
  return shadow;
}

std::string to_text(const Shadow& shadow) {
  if (!shadow.failure.empty()) return fmt::format("shadow\n  {} failed: {}\n", shadow.precision, shadow.failure);
  return fmt::format("shadow\n  against {}, compared {}: {} kept the fewest digits, {:.1f} at t = {}\n",
                     shadow.precision,
                     shadow.every == 1 ? "at every step" : fmt::format("every {} steps", shadow.every),
                     shadow.worst.component, shadow.worst.digits, shadow.worst.t);
}

#define HBVM_DEFINE(S) template class ShadowedRun<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

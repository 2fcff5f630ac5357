#include "integrate/time_grid.hpp"

#include <cmath>

#include "scalar/literal.hpp"
#include "scalar/text.hpp"

namespace hbvm::core {
namespace {

template <Scalar S>
S positive(const Expression& expression, const Constants& constants, const std::string& what) {
  try {
    S value = evaluate<S>(expression, constants);
    if (value > 0) return value;
  } catch (const InputError& error) {
    throw InputError(what + " " + error.what());
  }
  throw InputError(what + " '" + expression.text() + "' is not positive");
}

}  // namespace

template <Scalar S>
TimeGrid<S>::TimeGrid(const Expression& step, const Expression& until, const Constants& constants, Direction direction,
                      LastStep last)
    : step_(positive<S>(step, constants, "step")),
      until_(positive<S>(until, constants, "until")),
      last_step_(step_),
      direction_(direction) {
  using std::floor;
  const S half = S(1) / 2;
  const S quotient = floor(S(until_ / step_ + half));
  if (!(quotient <= S(max_steps)))
    throw InputError("step '" + step.text() + "' is too small: more than " + max_steps_text + " steps until '" +
                     until.text() + "'");
  steps_ = static_cast<long>(quotient);
  const S miss = magnitude(S(S(steps_) * step_ - until_));
  if (steps_ > 0 && miss <= 4 * epsilon<S>() * until_) return;
  if (last == LastStep::refused)
    throw InputError("step '" + step.text() + "' does not divide the interval: " + std::to_string(steps_) +
                     " steps miss until '" + until.text() + "' by " + to_scientific(miss, 3));
  is_even_ = false;
  steps_ = static_cast<long>(floor(S(until_ / step_))) + 1;
  last_step_ = until_ - step_ * S(steps_ - 1);
  // The quotient may have been rounded up.
  if (!(last_step_ > 0)) last_step_ = until_ - step_ * S(--steps_ - 1);
}

template <Scalar S>
S TimeGrid<S>::time(long n) const {
  const S t = n == steps_ ? until_ : is_even_ ? S(until_ * S(n) / S(steps_)) : S(step_ * S(n));
  return direction_ == Direction::backward ? S(-t) : t;
}

#define HBVM_DEFINE(S) template class TimeGrid<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

#pragma once

#include "scalar/expression.hpp"
#include "scalar/scalar.hpp"

namespace hbvm::core {

enum class Direction { forward, backward };

/// What becomes of the last step, if the end is no multiple of the step.
enum class LastStep { refused, shortened };

/// Mesh points t_n = until n / N, n = 0..N, and their opposites for a run back in time. They are computed, never
/// accumulated.
template <Scalar S>
class TimeGrid {
 public:
  /// A browser counts to 2^31.
  static constexpr bool counts_far = sizeof(long) > 4;
  static constexpr long max_steps = static_cast<long>(counts_far ? 1'000'000'000'000LL : 1'000'000'000LL);
  static constexpr const char* max_steps_text = counts_far ? "10^12" : "10^9";

  /// N = round(until/step).
  /// \throws InputError unless step and until are positive, |N step - until| <= 4 epsilon until and N <= max_steps.
  /// With LastStep::shortened any end will do. Where it is no multiple of the step, t_n = n step before it.
  TimeGrid(const Expression& step, const Expression& until, const Constants& constants = {},
           Direction direction = Direction::forward, LastStep last = LastStep::refused);

  const S& step() const { return step_; }
  const S& last_step() const { return last_step_; }
  bool is_even() const { return is_even_; }
  const S& until() const { return until_; }
  Direction direction() const { return direction_; }
  long steps() const { return steps_; }
  S time(long n) const;

 private:
  S step_, until_, last_step_;
  bool is_even_ = true;
  Direction direction_;
  long steps_ = 0;
};

}  // namespace hbvm::core

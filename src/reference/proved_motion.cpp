#include "reference/proved_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hbvm::core {
namespace {

/// Bits of bounds and of rates.
constexpr slong few_bits = 64;

RealBall middle_of(RealBall x) {
  arb_get_mid_arb(raw(x), raw(x));
  return x;
}

}  // namespace

ProvedMotion::ProvedMotion(const Assembled<Mpfr>& exact, const Assembled<Mpfr>& rounded, const Mpfr& until,
                           std::function<double(double)> omega, const std::function<void()>& while_working)
    : bounds_(
          exact, while_working ? while_working : [] {}),
      omega_(std::move(omega)),
      until_(until),
      motion_(
          rounded.problem, rounded.q0, rounded.p0, while_working ? while_working : [] {}) {
  begin_step();
  const double at_start = omega_(0);
  take_up({rounded_up(bounds_.distance_of_start(*step_, at_start)), at_start});
}

double ProvedMotion::time_at(const RealBall& s) const { return centre_of(raw(start_ + s * step_->unit())); }

std::string ProvedMotion::beyond(const std::string& why) const {
  return fmt::format("nothing can be proved beyond t = {:.10g}: {}", centre_of(raw(start_)), why);
}

void ProvedMotion::begin_step() {
  // What lies beyond the last time is of no concern, but for a little, so that this time is within the step.
  constexpr int parts = 8;
  const BallScope scope(bounds_.bits());
  motion_.shorten((until_ - motion_.start()) * (parts + 1) / parts);
  step_ = step_of(motion_, bounds_.problem());
}

Defect ProvedMotion::defect_of_step() {
  constexpr int attempts = 24, parts = 8;
  for (int attempt = 1;; ++attempt) try {
      return bounds_.defect(*step_);
    } catch (const IntegrationError& error) {
      if (attempt == attempts) throw IntegrationError(beyond(error.what()));
      const BallScope scope(bounds_.bits());
      motion_.shorten(motion_.length() * (parts - 1) / parts);
      step_ = step_of(motion_, bounds_.problem());
    }
}

std::vector<PieceEnd> ProvedMotion::pieces(int count) const {
  std::vector<PieceEnd> result;
  RealBall from;
  for (int i = 1; i <= count; ++i) {
    const RealBall to = i == count ? step_->end() : middle_of(step_->end() * RealBall(i) / RealBall(count));
    result.push_back({to, omega_(time_at((from + to) / RealBall(2)))});
    from = to;
  }
  return result;
}

void ProvedMotion::take_up(const ErrorDistance& before) {
  const Defect defect = defect_of_step();
  const BallScope scope(few_bits);
  // Wider than errors will be, and not much wider.
  constexpr int room = 16, most_pieces = 1024, most_tubes = 8;
  constexpr double infinite = std::numeric_limits<double>::infinity();
  RealBall least = bounds_.size_at_start(*step_, before.omega);
  arb_mul_2exp_si(raw(least), raw(least), -bounds_.bits());
  ErrorDistance tube{rounded_up((least + before.length + defect.force * step_->end() * step_->unit()) * RealBall(room)),
                     before.omega};
  for (int tries = 0; tries < most_tubes; ++tries) {
    double total = infinite;
    std::string obstacle = "errors may grow without bound";
    std::vector<PieceEnd> taken;
    for (int count = std::max(2, count_ / 2); count <= most_pieces; count *= 2) {
      const std::vector<PieceEnd> ends = pieces(count);
      StepCourse found{{}, {}, infinite};
      try {
        found = bounds_.course(*step_, defect, tube, ends);
      } catch (const IntegrationError& error) {
        obstacle = error.what();
        continue;
      }
      const double next = found.growth;
      if (!std::isfinite(next)) continue;
      // Halving them once more would gain little.
      constexpr double little = double{1} / 8;
      const double gain = total - next;
      if (gain > 0) {
        course_ = std::move(found);
        taken = ends;
        count_ = count;
        total = next;
      }
      if (gain < little * (1 + next)) break;
    }
    if (!std::isfinite(total)) throw BoundsTooWide(beyond(obstacle));
    ErrorDistance after = course_.distance_at(step_->end(), before);
    if (course_.stays_in_tube(before)) {
      growth_ += total;
      after.length = rounded_up(after.length);
      proved_ = ProvedStep{*step_, before, tube, after, taken};
      return;
    }
    tube.length = rounded_up(greater(tube.length, after.length) * RealBall(room));
  }
  throw BoundsTooWide(beyond("the bounds become too wide"));
}

ProvedState ProvedMotion::at(const RealBall& t, const std::function<void(double)>& after_step) {
  for (;;) {
    const BallScope scope(bounds_.bits());
    const RealBall s = (t - start_) / step_->unit();
    if (s.is_below(step_->end())) {
      if (arb_is_nonnegative(raw(s)) == 0)
        throw BoundsTooWide(beyond("a time is where a step begins, but for rounding"));
      return bounds_.state(*step_, s, course_.distance_at(s, proved_->before));
    }
    if (keep) keep(*proved_);
    start_ = proved_->series.end_time(start_);
    motion_.next_step();
    begin_step();
    ErrorDistance next = proved_->after;
    next.length = rounded_up(next.length + bounds_.jump(proved_->series, *step_, next.omega));
    take_up(next);
    if (after_step) after_step(centre_of(raw(start_)));
  }
}

}  // namespace hbvm::core

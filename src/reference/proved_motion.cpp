#include "reference/proved_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hbvm/error.hpp"

namespace hbvm::core {
namespace {

/// Bits of bounds and of rates.
constexpr slong few_bits = 64;

std::vector<RealBall> differences(std::vector<RealBall> a, const std::vector<RealBall>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return a;
}

std::vector<RealBall> all_believed(const Vector<Mpfr>& x) {
  std::vector<RealBall> result;
  for (const Mpfr& value : x) result.push_back(believed(value));
  return result;
}

double upper(const RealBall& x) {
  RealBall bound;
  arb_get_ubound_arf(arb_midref(raw(bound)), raw(x), few_bits);
  return arf_get_d(arb_midref(raw(bound)), ARF_RND_UP);
}

}  // namespace

ProvedMotion::Distance ProvedMotion::Distance::measured_by(double other) const {
  if (other <= omega) return {length, other};
  return {greatest_magnitude(length * exact_ball(other) / exact_ball(omega)), other};
}

ProvedMotion::ProvedMotion(const Assembled<Mpfr>& exact, const Assembled<Mpfr>& rounded, const Mpfr& until,
                           std::function<double(double)> omega, std::function<void()> while_working)
    : problem_(rounded.problem),
      balls_([&] {
        const PrecisionScope all(2 * Mpfr::thread_default_precision());
        const BallScope scope(significand_bits<Mpfr>());
        return BallProblem(exact.problem);
      }()),
      bound_(balls_, exact.problem),
      growth_in_([&] {
        const BallScope scope(2 * significand_bits<Mpfr>());
        return ErrorGrowthIn(balls_);
      }()),
      omega_(std::move(omega)),
      bits_(significand_bits<Mpfr>() + 32),
      until_(until),
      while_working_(while_working ? std::move(while_working) : [] {}),
      motion_(rounded.problem, rounded.q0, rounded.p0, while_working_) {
  const BallScope scope(bits_);
  begin_step();
  const RealBall zero;
  distance_.omega = omega_(0);
  distance_.length =
      length(differences(all_believed(exact.q0), step_->positions(zero)),
             differences(balls_.velocity(all_believed(exact.p0)), step_->velocities(zero)), distance_.omega);
  take_up();
}

RealBall ProvedMotion::length(const std::vector<RealBall>& dq, const std::vector<RealBall>& dv, double omega) const {
  return growth_in_.length(dq, dv, exact_ball(omega));
}

double ProvedMotion::time_at(const RealBall& s) const { return centre_of(raw(start_ + s * step_->unit())); }

std::string ProvedMotion::beyond(const std::string& why) const {
  return fmt::format("nothing can be proved beyond t = {:.10g}: {}", centre_of(raw(start_)), why);
}

void ProvedMotion::refuse(const std::string& why) const { throw IntegrationError(beyond(why)); }

PathBox ProvedMotion::box(const SeriesStep& step, const RealBall& s, const Distance& distance) const {
  PathBox result{step.positions(s), step.velocities(s), step.accelerations(s)};
  const RealBall of_q = distance.length / exact_ball(distance.omega);
  for (Index j = 0; j < balls_.m(); ++j) {
    const auto i = static_cast<std::size_t>(j);
    result.q[i] = widened(std::move(result.q[i]), growth_in_.velocity_reach(j) * of_q);
    result.v[i] = widened(std::move(result.v[i]), growth_in_.velocity_reach(j) * distance.length);
  }
  return result;
}

std::vector<ProvedMotion::Piece> ProvedMotion::pieces(const Defect& defect, const Distance& tube, int count,
                                                      double& total) const {
  const SeriesStep step = step_->rounded();
  std::vector<Piece> result;
  total = 0;
  Distance wide = tube;
  for (int i = 0; i < count; ++i) {
    while_working_();
    const RealBall parts = count;
    const RealBall from = step_->end() * RealBall(i) / parts, to = step_->end() * RealBall(i + 1) / parts;
    RealBall both, middle;
    arb_union(raw(both), raw(from), raw(to), few_bits);
    arb_get_mid_arb(raw(middle), raw(both));
    const double omega = omega_(time_at(middle));
    total += std::max(double{0}, std::log(omega / wide.omega));
    wide = wide.measured_by(omega);
    const ErrorGrowth growth = growth_in_(box(step, middle, wide), box(step, both, wide), both * step.unit());
    Piece& piece = result.emplace_back(Piece{to, omega, exact_ball(growth.rate(omega)), {}, wide.length});
    // The part of the defect along grad g is g'' over the gradient; the rest is e without its part along grad g.
    RealBall square;
    for (Index a = 0; a < balls_.nu(); ++a)
      for (Index b = 0; b < balls_.nu(); ++b)
        square += defect.bending[static_cast<std::size_t>(a)] * defect.bending[static_cast<std::size_t>(b)] *
                  greatest_magnitude(growth.gram_inverse.at(a, b));
    piece.defect = greatest_magnitude(defect.force + square_root(square));
    total += std::max(double{0}, upper(piece.rate * (to - from) * step.unit()));
    if (!std::isfinite(total)) break;
  }
  return result;
}

ProvedMotion::Distance ProvedMotion::passed(Distance distance, const Piece& piece, const RealBall& time) {
  distance = distance.measured_by(piece.omega);
  // The defect grows with errors, or for a negative rate is there by itself.
  const RealBall factor = exponential(piece.rate * time);
  const RealBall of_defect = piece.defect * time * greater(RealBall(1), greatest_magnitude(factor));
  distance.length = greatest_magnitude(distance.length * factor + of_defect);
  return distance;
}

ProvedMotion::Distance ProvedMotion::distance_at(const RealBall& s) const {
  Distance distance = distance_;
  RealBall from;
  const RealBall latest = greatest_magnitude(s);
  for (const Piece& piece : pieces_) {
    const bool last = !piece.end.is_below(latest);
    distance = passed(distance, piece, ((last ? s : piece.end) - from) * step_->unit());
    if (last) break;
    from = piece.end;
  }
  return distance;
}

bool ProvedMotion::stays_in_tube() const {
  Distance distance = distance_;
  RealBall from;
  for (const Piece& piece : pieces_) {
    // Between its ends it is no more than at one of them, and what the defect adds.
    const RealBall time = (piece.end - from) * step_->unit();
    const RealBall before = distance.measured_by(piece.omega).length;
    distance = passed(distance, piece, time);
    const RealBall most = greater(before, distance.length) + piece.defect * time;
    if (!most.is_finite() || !most.is_below(piece.tube)) return false;
    from = piece.end;
  }
  return true;
}

void ProvedMotion::begin_step() {
  // What lies beyond the last time is of no concern, but for a little, so that this time is within the step.
  constexpr int parts = 8;
  motion_.shorten((until_ - motion_.start()) * (parts + 1) / parts);
  step_ = step_of(motion_, balls_);
}

Defect ProvedMotion::defect_of_step() {
  const BallScope scope(bits_);
  Vector<Mpfr> q(balls_.m()), v(balls_.m());
  for (Index j = 0; j < balls_.m(); ++j) {
    q[j] = motion_.position(j)[0];
    v[j] = motion_.position(j)[1] / motion_.unit();
  }
  const Vector<Mpfr> p = problem_.mass.momentum(v);
  constexpr int attempts = 24, parts = 8;
  for (int attempt = 1;; ++attempt) try {
      return bound_.of(*step_, q, p);
    } catch (const IntegrationError& error) {
      if (attempt == attempts) refuse(error.what());
      motion_.shorten(motion_.length() * (parts - 1) / parts);
      step_ = step_of(motion_, balls_);
    }
}

void ProvedMotion::take_up() {
  const Defect defect = defect_of_step();
  const BallScope scope(few_bits);
  // Wider than errors will be, and not much wider.
  constexpr int room = 16, most_pieces = 1024, most_tubes = 8;
  const RealBall zero, duration = step_->end() * step_->unit();
  RealBall least = length(step_->rounded().positions(zero), step_->rounded().velocities(zero), distance_.omega);
  arb_mul_2exp_si(raw(least), raw(least), -bits_);
  Distance tube{greatest_magnitude((least + distance_.length + defect.force * duration) * RealBall(room)),
                distance_.omega};
  for (int tries = 0; tries < most_tubes; ++tries) {
    double total = std::numeric_limits<double>::infinity();
    std::string obstacle = "errors may grow without bound";
    for (int count = std::max(2, count_ / 2); count <= most_pieces; count *= 2) {
      double next = std::numeric_limits<double>::infinity();
      std::vector<Piece> found;
      try {
        found = pieces(defect, tube, count, next);
      } catch (const IntegrationError& error) {
        obstacle = error.what();
        continue;
      }
      if (!std::isfinite(next)) continue;
      // Halving them once more would gain little.
      constexpr double little = double{1} / 8;
      const double gain = total - next;
      if (gain > 0) {
        pieces_ = std::move(found);
        count_ = count;
        total = next;
      }
      if (gain < little * (1 + next)) break;
    }
    if (!std::isfinite(total)) throw BoundsTooWide(beyond(obstacle));
    if (stays_in_tube()) {
      growth_ += total;
      return;
    }
    tube.length = greater(tube.length, distance_at(step_->end()).length);
    tube.length = greatest_magnitude(tube.length * RealBall(room));
  }
  throw BoundsTooWide(beyond("the bounds become too wide"));
}

ProvedState ProvedMotion::at(const RealBall& t, const std::function<void(double)>& after_step) {
  const BallScope scope(bits_);
  for (;;) {
    const RealBall s = (t - start_) / step_->unit();
    if (s.is_below(step_->end())) {
      const Distance distance = distance_at(s);
      const PathBox here = box(*step_, s, distance);
      ProvedState state{here.q, balls_.momentum(step_->velocities(s)), growth_in_.multipliers(here), {}};
      for (Index j = 0; j < balls_.m(); ++j) {
        const auto i = static_cast<std::size_t>(j);
        state.p[i] = widened(std::move(state.p[i]), growth_in_.momentum_reach(j) * distance.length);
        state.H += here.v[i] * state.p[i] / RealBall(2);
      }
      state.H += balls_.potential_energy(here.q);
      return state;
    }
    const std::vector<RealBall> q = step_->positions(step_->end()), v = step_->velocities(step_->end());
    distance_ = distance_at(step_->end());
    start_ += step_->end() * step_->unit();
    motion_.next_step();
    begin_step();
    const RealBall zero;
    distance_.length =
        greatest_magnitude(distance_.length + length(differences(q, step_->positions(zero)),
                                                     differences(v, step_->velocities(zero)), distance_.omega));
    take_up();
    if (after_step) after_step(centre_of(raw(start_)));
  }
}

}  // namespace hbvm::core

#include "step_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hbvm::core {
namespace {

std::vector<RealBall> differences(std::vector<RealBall> a, const std::vector<RealBall>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return a;
}

Vector<Mpfr> rough(const std::vector<RealBall>& x) {
  Vector<Mpfr> result(static_cast<Index>(x.size()));
  for (std::size_t i = 0; i < x.size(); ++i)
    arf_get_mpfr(raw(result[static_cast<Index>(i)]), arb_midref(raw(x[i])), MPFR_RNDN);
  return result;
}

}  // namespace

StepBounds::StepBounds(const Assembled<Mpfr>& exact, std::function<void()> while_working)
    : exact_(exact),
      bits_(significand_bits<Mpfr>() + 32),
      balls_(ball_problem_of(exact.problem)),
      bound_(balls_, exact.problem),
      growth_in_([&] {
        const BallScope scope(2 * significand_bits<Mpfr>());
        return ErrorGrowthIn(balls_);
      }()),
      while_working_(std::move(while_working)) {}

Defect StepBounds::defect(const SeriesStep& step) {
  const BallScope scope(bits_);
  const RealBall zero;
  return bound_.of(step, rough(step.positions(zero)), rough(balls_.momentum(step.velocities(zero))));
}

PathBox StepBounds::box(const SeriesStep& step, const RealBall& s, const ErrorDistance& distance) const {
  PathBox result{step.positions(s), step.velocities(s), step.accelerations(s)};
  const RealBall of_q = distance.length / exact_ball(distance.omega);
  for (Index j = 0; j < balls_.m(); ++j) {
    const auto i = static_cast<std::size_t>(j);
    result.q[i] = widened(std::move(result.q[i]), growth_in_.velocity_reach(j) * of_q);
    result.v[i] = widened(std::move(result.v[i]), growth_in_.velocity_reach(j) * distance.length);
  }
  return result;
}

StepCourse StepBounds::course(const SeriesStep& step, const Defect& defect, const ErrorDistance& tube,
                              const std::vector<PieceEnd>& pieces) const {
  const SeriesStep few = step.rounded();
  StepCourse result{{}, step.unit(), 0};
  ErrorDistance wide = tube;
  RealBall from;
  for (const PieceEnd& piece : pieces) {
    while_working_();
    RealBall both, middle;
    arb_union(raw(both), raw(from), raw(piece.end), BallScope::bits());
    arb_get_mid_arb(raw(middle), raw(both));
    result.growth += std::max(double{0}, std::log(piece.omega / wide.omega));
    wide = wide.measured_by(piece.omega);
    const ErrorGrowth growth = growth_in_(box(few, middle, wide), box(few, both, wide), both * step.unit());
    // The part of the defect along grad g is g'' over the gradient; the rest is e without its part along grad g.
    RealBall square;
    for (Index a = 0; a < balls_.nu(); ++a)
      for (Index b = 0; b < balls_.nu(); ++b)
        square += defect.bending[static_cast<std::size_t>(a)] * defect.bending[static_cast<std::size_t>(b)] *
                  greatest_magnitude(growth.gram_inverse.at(a, b));
    result.pieces.push_back({piece.end, piece.omega, exact_ball(growth.rate(piece.omega)),
                             greatest_magnitude(defect.force + square_root(square)), wide.length});
    const RealBall exponent = result.pieces.back().rate * (piece.end - from) * step.unit();
    if (!exponent.is_finite()) {
      result.growth = std::numeric_limits<double>::infinity();
      break;
    }
    result.growth += std::max(double{0}, centre_of(raw(exponent)));
    from = piece.end;
  }
  return result;
}

RealBall StepBounds::distance_of_start(const SeriesStep& step, double omega) const {
  const BallScope scope(bits_);
  const RealBall zero;
  return growth_in_.length(differences(believed(exact_.q0), step.positions(zero)),
                           differences(balls_.velocity(believed(exact_.p0)), step.velocities(zero)), exact_ball(omega));
}

RealBall StepBounds::jump(const SeriesStep& step, const SeriesStep& next, double omega) const {
  const BallScope scope(bits_);
  const RealBall zero;
  return growth_in_.length(differences(step.positions(step.end()), next.positions(zero)),
                           differences(step.velocities(step.end()), next.velocities(zero)), exact_ball(omega));
}

RealBall StepBounds::size_at_start(const SeriesStep& step, double omega) const {
  const SeriesStep few = step.rounded();
  const RealBall zero;
  return growth_in_.length(few.positions(zero), few.velocities(zero), exact_ball(omega));
}

ProvedState StepBounds::state(const SeriesStep& step, const RealBall& s, const ErrorDistance& distance) const {
  const BallScope scope(bits_);
  const PathBox here = box(step, s, distance);
  ProvedState state{here.q, balls_.momentum(step.velocities(s)), growth_in_.multipliers(here), {}};
  for (Index j = 0; j < balls_.m(); ++j) {
    const auto i = static_cast<std::size_t>(j);
    state.p[i] = widened(std::move(state.p[i]), growth_in_.momentum_reach(j) * distance.length);
    state.H += here.v[i] * state.p[i] / RealBall(2);
  }
  state.H += balls_.potential_energy(here.q);
  return state;
}

RealBall rounded_up(const RealBall& bound) {
  constexpr slong bits = 24;
  constexpr int more = -16;
  RealBall result = greatest_magnitude(bound), little = result;
  arb_mul_2exp_si(raw(little), raw(little), more);
  arb_add(raw(result), raw(result), raw(little), BallScope::bits());
  arf_t rounded;
  arf_init(rounded);
  arb_get_ubound_arf(rounded, raw(result), bits);
  arb_set_arf(raw(result), rounded);
  arf_clear(rounded);
  return result;
}

}  // namespace hbvm::core

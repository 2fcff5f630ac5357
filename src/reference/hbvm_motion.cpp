#include "hbvm_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hbvm/error.hpp"
#include "linear/product.hpp"
#include "scalar/log2_of.hpp"
#include "scalar/text.hpp"

namespace hbvm::core {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

}  // namespace

HbvmMotion::HbvmMotion(const Problem<Mpfr>& problem, const Hbvm<Mpfr>& method, const Vector<Mpfr>& q,
                       const Vector<Mpfr>& p, double digits, const Mpfr& longest)
    : problem_(problem),
      method_(method),
      stepper_(problem, method, SolverKind::newton),
      bounds_(problem),
      point_(problem),
      state_(q, p),
      log2_rho_(digits * std::log2(double{10}) / (2 * method.s)),
      log2_h_(std::min(log2_of(longest), first_length())),
      most_log2_(log2_h_) {}

ExactPoint HbvmMotion::output() {
  const Vector<Mpfr> tangential = point_.tangential(state_.q, state_.p);
  return {state_.q, tangential, point_.multiplier(state_.q, tangential)};
}

double HbvmMotion::first_length() {
  // A step that is far too long costs more than some that are too short.
  constexpr double part = 2;
  Vector<Mpfr> v(state_.p.size()), acceleration(v.size());
  const Vector<Mpfr> force = point_.force(state_.q, state_.p);
  problem_.mass.velocity(lanes(state_.p), lanes(v));
  problem_.mass.velocity(lanes(force), lanes(acceleration));
  double least = infinite;
  for (const SpaceBlock& block : problem_.blocks) {
    const auto size = [&](const Vector<Mpfr>& x) {
      double result = -infinite;
      for (Index j = block.offset; j < block.offset + problem_.dimension; ++j) result = std::max(result, log2_of(x[j]));
      return result;
    };
    const double place = size(state_.q);
    if (std::isinf(place)) continue;
    least = std::min({least, place - size(v), (place - size(acceleration)) / 2});
  }
  return least - part;
}

double HbvmMotion::room(double log2_h) const {
  const Matrix<Mpfr>& gamma = stepper_.solver().unknowns().gamma;
  const Index s = gamma.rows();
  const double bits = significand_bits<Mpfr>();
  double least = infinite;
  for (std::size_t b = 0; b < problem_.mass.blocks().size(); ++b) {
    const auto& block = problem_.mass.blocks()[b];
    const auto size = [&](Index n) {
      double result = -infinite;
      for (Index j = block.offset; j < block.offset + block.size; ++j) result = std::max(result, log2_of(gamma(n, j)));
      return result;
    };
    double scale = size(0);
    for (Index n = 1; n < s; ++n) scale = std::max(scale, size(n));
    // What rounding of the forces leaves, of a body at rest.
    constexpr int units = 10;
    const double nothing = bounds_.scales(log2_h)[b] - bits + units;
    for (const Index n : {s - 2, s - 1})
      if (const double tail = size(n); tail > nothing)
        least = std::min(least, (scale - tail) / static_cast<double>(n) - log2_rho_);
  }
  return least;
}

void HbvmMotion::set_driven(const State<Mpfr>& from, const Mpfr& h, Matrix<Mpfr>& v) const {
  DrivenCourse<Mpfr> course(problem_, method_.c.size());
  if (course.empty()) return;
  for (Index i = 0; i < method_.c.size(); ++i) course.time(i) = from.q[problem_.clock()] + method_.c[i] * h;
  course.evaluate();
  Matrix<Mpfr> at_nodes = Matrix<Mpfr>::Zero(method_.c.size(), problem_.m()), coefficients(v.rows(), v.cols());
  course.set_velocities(lanes(at_nodes));
  product<Mpfr>(coefficients, method_.projection, at_nodes);
  for (Index j = problem_.clock(); j < v.cols(); ++j) v.col(j) = coefficients.col(j);
}

bool HbvmMotion::is_bounded(const State<Mpfr>& from, const Mpfr& h, double log2_h, double log2_rho) {
  const StageUnknowns<Mpfr>& x = stepper_.solver().unknowns();
  const Index d = problem_.dimension, s = x.gamma.rows();
  Matrix<Mpfr> v(s, x.gamma.cols()), acceleration(v);
  problem_.mass.velocity(lanes(x.gamma), lanes(v));
  set_driven(from, h, v);
  const auto along = [&](const Displacement<Mpfr>& of, Index component, const Vector<Mpfr>& start_of,
                         const Matrix<Mpfr>& rates_of, bool shifted) {
    Mpfr start = shifted && of.shift.size() > 0 ? of.shift[component] : Mpfr(0);
    std::vector<Mpfr> rates(static_cast<std::size_t>(s), Mpfr(0));
    for (const auto& block : of.blocks) {
      start += block.weight * start_of[block.offset + component];
      for (Index n = 0; n < s; ++n)
        rates[static_cast<std::size_t>(n)] += block.weight * h * rates_of(n, block.offset + component);
    }
    return ellipse_of(start, rates, log2_rho);
  };
  const auto effects = [&](std::size_t force, Index input) {
    return along(bounds_.forces()[force].displacement(input, d), input % d, from.q, v, true);
  };
  if (problem_.is_conservative()) return bounds_.hold(log2_h, effects);
  Vector<Mpfr> v0(from.p.size());
  problem_.mass.velocity(lanes(from.p), lanes(v0));
  const Matrix<Mpfr> force = x.psi - x.zeta;
  problem_.mass.velocity(lanes(force), lanes(acceleration));
  const auto forces = [&](std::size_t number, Index input) {
    const ForceBounds::Pull& pull = bounds_.pulls()[number];
    const Index inputs = pull.term->arguments * d, component = input % d;
    const Displacement<Mpfr>& of = pull.term->displacement(pull.instance, input % inputs / d);
    return input < inputs ? along(of, component, from.q, v, true) : along(of, component, v0, acceleration, false);
  };
  return bounds_.hold(log2_h, effects, forces, [&] { return ellipse_of(from.q[problem_.clock()], {h}, log2_rho); });
}

void HbvmMotion::shorten(double by, const std::string& why) {
  log2_h_ -= by;
  const double bits = significand_bits<Mpfr>();
  if (!(log2_h_ > most_log2_ - 2 * bits) || !(log2_h_ > log2_of(now_) - bits))
    throw IntegrationError("the motion cannot be followed beyond t = " + to_scientific(now_, 10) + ": " + why);
}

void HbvmMotion::advance_to(const Mpfr& t, const std::function<void(const Mpfr&)>& after_step) {
  // log2 of how many times as long a step may be. These are the least, that when its length is chosen, and the most
  // before another length is worth its new matrix.
  constexpr double least_room = double{5} / 100, usual_room = double{2} / 10, much_room = double{5} / 10, most_rise = 1,
                   most_fall = 4, fall = double{1} / 2, most_trend = double{3} / 10;
  // As of a Taylor series: what forces may be beside the terms that are left out.
  constexpr double slack = 10;
  const double log2_ellipse = log2_rho_ - (slack - ForceBounds::allowed_bits) /
                                              static_cast<double>(2 * stepper_.solver().unknowns().gamma.rows());
  double last_length = -infinite;
  while (now_ < t) {
    const Mpfr left = t - now_, whole = power_of_two(log2_h_);
    // Two steps of half the length rather than a short last one.
    const Mpfr h = left <= whole ? left : left < 2 * whole ? Mpfr(left / 2) : whole;
    const double log2_h = log2_of(h);
    const State<Mpfr> before = state_;
    bounds_.start(before.q, before.p);
    const auto again = [&](double by, const std::string& why) {
      state_ = before;
      log2_h_ = log2_h;
      shorten(by, why);
    };
    try {
      stepper_.step(state_, h);
    } catch (const StageFailure& failure) {
      again(2, failure.what());
      continue;
    }
    const double found = room(log2_h);
    if (found < least_room) {
      again(std::min(usual_room - found, most_fall), "no step is short enough for its polynomial to be exact");
      continue;
    }
    if (!is_bounded(before, h, log2_h, log2_ellipse)) {
      again(fall, bounds_.obstacle());
      continue;
    }
    // The length that would have done; where it falls from step to step, it goes on to.
    const double length = log2_h + std::min(found, most_rise + usual_room);
    const double expected = length + std::clamp(length - last_length, -most_trend, double{0}) - log2_h;
    last_length = length;
    if (expected < least_room) {
      log2_h_ = log2_h + expected - usual_room;
    } else if (expected > much_room && h == whole) {
      double rise = std::min(expected - usual_room, most_rise);
      while (rise > least_room && !is_bounded(before, h, log2_h, log2_ellipse + rise)) rise /= 2;
      if (rise > least_room) log2_h_ += rise;
    }
    now_ = h == left ? t : Mpfr(now_ + h);
    ++steps_;
    after_step(now_);
  }
}

}  // namespace hbvm::core

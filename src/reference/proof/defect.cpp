#include "defect.hpp"

#include <cmath>
#include <limits>

#include "hbvm/error.hpp"

namespace hbvm::core {
namespace {

/// x(s) on the circle |s| = 2^log2_radius.
Loop loop_of(const BallSeries& x, double log2_radius) {
  const auto length = static_cast<std::size_t>(x.length());
  std::vector<double> fractions(length), exponents(length);
  RealBall unsure;  // by what the coefficients may be off
  double greatest = -std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < length; ++n) {
    RealBall a = x[static_cast<Index>(n)];
    RealBall radius;
    arf_set_mag(arb_midref(raw(radius)), arb_radref(raw(a)));
    unsure += radius * power_of_two_of(static_cast<double>(n) * log2_radius);
    if (arf_is_zero(arb_midref(raw(a))) != 0) continue;
    const slong exponent = arf_abs_bound_lt_2exp_si(arb_midref(raw(a)));
    arb_mul_2exp_si(raw(a), raw(a), -exponent);
    fractions[n] = arf_get_d(arb_midref(raw(a)), ARF_RND_NEAR);
    exponents[n] = static_cast<double>(exponent) + static_cast<double>(n) * log2_radius;
    greatest = std::max(greatest, exponents[n]);
  }
  if (std::isinf(greatest)) greatest = 0;
  const double unit = std::ceil(greatest);
  for (std::size_t n = 0; n < length; ++n) fractions[n] *= std::exp2(exponents[n] - unit);
  unsure = greatest_magnitude(unsure);
  arb_mul_2exp_si(raw(unsure), raw(unsure), -static_cast<slong>(unit));
  const double error = arf_get_d(arb_midref(raw(unsure)), ARF_RND_UP);
  if (fractions.empty()) fractions.push_back(0);
  return {std::move(fractions), 0, static_cast<long>(unit), error};
}

double log2_of(const RealBall& x) {
  RealBall size = greatest_magnitude(x);
  const slong exponent = arf_abs_bound_lt_2exp_si(arb_midref(raw(size)));
  arb_mul_2exp_si(raw(size), raw(size), -exponent);
  return static_cast<double>(exponent) + std::log2(arf_get_d(arb_midref(raw(size)), ARF_RND_NEAR));
}

}  // namespace

DefectBound::DefectBound(const BallProblem& balls, const Problem<Mpfr>& problem) : balls_(balls), bounds_(problem) {}

DefectBound::Circle DefectBound::circle_of(const SeriesStep& step) const {
  // That far out, the terms beyond the order of what is 2^allowed_bits as large as the forces are round-off. A radius
  // of few bits has powers without rounding.
  constexpr double slack = 20, parts = 64;
  const double bits = significand_bits<Mpfr>(), order = static_cast<double>(step.order());
  const double out = (bits - slack + ForceBounds::allowed_bits) / order;
  Circle circle{std::floor((log2_of(step.end()) + out) * parts) / parts, {}, {}, {}};
  circle.radius = power_of_two_of(circle.log2_radius);
  // x^N / (1 - x) and, of the derivative, sum_{n >= N} n x^n over the time: x^N (N - (N - 1) x) / (1 - x)^2.
  const RealBall x = greatest_magnitude(step.end()) / circle.radius, rest = RealBall(1) - x;
  const auto N = static_cast<unsigned long>(step.order());
  circle.tail = power(x, N) / rest;
  const int whole = static_cast<int>(N);
  circle.tail_of_derivative = circle.tail * (RealBall(whole) - RealBall(whole - 1) * x) / rest / step.end();
  return circle;
}

std::vector<std::vector<RealBall>> DefectBound::bounds_on(const Circle& circle, const SeriesStep& step,
                                                          double log2_length) {
  std::vector<const BallForce*> all;
  for (const BallForce& force : balls_.forces()) all.push_back(&force);
  for (const BallConstraint& constraint : balls_.constraints())
    if (constraint.formula) all.push_back(&*constraint.formula);
  const auto input = [&](std::size_t force, Index i) {
    return loop_of(all[force]->input(static_cast<std::size_t>(i), step.q()), circle.log2_radius);
  };
  if (!bounds_.hold(log2_length, input)) throw IntegrationError(bounds_.obstacle());
  std::vector<std::vector<RealBall>> result;
  for (std::size_t f = 0; f < bounds_.forces().size(); ++f) {
    std::vector<RealBall>& of_force = result.emplace_back();
    // A constant force has nothing beyond the order. Sizes in log2 are rounded: one more than what was compared is a
    // bound.
    const bool constant = bounds_.forces()[f].term->constant_force;
    for (const double limit : bounds_.limits(f, log2_length))
      of_force.push_back(constant ? RealBall() : power_of_two_of(std::ceil(limit) + 1));
  }
  return result;
}

Defect DefectBound::of(const SeriesStep& step, const Vector<Mpfr>& q, const Vector<Mpfr>& p) {
  const Index N = step.order(), m = balls_.m();
  const Circle circle = circle_of(step);
  bounds_.start(q, p);
  const auto on_circle = bounds_on(circle, step, log2_of(step.end() * step.unit()));
  const auto index = [](Index i) { return static_cast<std::size_t>(i); };
  const RealBall per_time = RealBall(1) / step.unit();

  std::vector<BallSeries> acceleration(index(m));
  for (Index j = 0; j < m; ++j) acceleration[index(j)] = step.scaled_v()[index(j)].derivative() * (per_time * per_time);
  std::vector<BallSeries> e = balls_.momentum(acceleration);
  std::vector<RealBall> beyond(index(m));  // bounds on the circle of what has terms beyond the order
  const std::vector<BallSeries> F = balls_.force(step.q(), N);
  for (Index j = 0; j < m; ++j) e[index(j)] -= F[index(j)];
  for (std::size_t f = 0; f < balls_.forces().size(); ++f)
    for (std::size_t i = 0; i < on_circle[f].size(); ++i)
      for (const BallPart& part : balls_.forces()[f].parts[i])
        beyond[index(part.coordinate)] += greatest_magnitude(part.weight) * on_circle[f][i];

  Defect defect;
  std::size_t formula = balls_.forces().size();
  for (Index a = 0; a < balls_.nu(); ++a) {
    const BallConstraint& constraint = balls_.constraints()[index(a)];
    const BallSeries& lambda = step.lambda()[index(a)];
    const RealBall lambda_size = lambda.size_within(circle.radius);
    BallSeries rate;      // (d/ds) g(q)
    RealBall rate_bound;  // on the circle
    std::vector<RealBall> bound;
    if (constraint.formula) {
      const auto& y = on_circle[formula++];
      bound.resize(index(m));
      for (std::size_t i = 0; i < y.size(); ++i)
        for (const BallPart& part : constraint.formula->parts[i])
          bound[index(part.coordinate)] += greatest_magnitude(part.weight) * y[i];
    }
    // All terms of what is affine: of the rest there are bounds.
    for (const BallSlope& slope : balls_.slopes(a, step.q(), constraint.formula ? N : N + 2)) {
      const std::size_t j = index(slope.coordinate);
      const RealBall size = constraint.formula ? bound[j] : slope.series.size_within(circle.radius);
      e[j] += slope.series.times(lambda, N);
      beyond[j] += size * lambda_size;
      rate += slope.series.times(step.scaled_v()[j], N);
      rate_bound += size * step.scaled_v()[j].size_within(circle.radius);
    }
    const RealBall own = rate.derivative().size_within(step.end());
    defect.bending.push_back(greatest_magnitude((own + rate_bound * circle.tail_of_derivative) * per_time * per_time));
  }
  std::vector<RealBall> size(index(m));
  for (Index j = 0; j < m; ++j)
    size[index(j)] = greatest_magnitude(e[index(j)].size_within(step.end()) + beyond[index(j)] * circle.tail);
  RealBall square;
  for (Index i = 0; i < m; ++i)
    for (Index j = 0; j < m; ++j)
      if (arb_is_zero(balls_.W()(i, j)) == 0)
        square += size[index(i)] * size[index(j)] * greatest_magnitude(balls_.W().at(i, j));
  defect.force = greatest_magnitude(square_root(square));
  return defect;
}

}  // namespace hbvm::core

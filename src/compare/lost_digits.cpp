#include "compare/lost_digits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <utility>

#include "hbvm/error.hpp"
#include "linear/product.hpp"
#include "reference/taylor.hpp"

namespace hbvm::core {

DriftGauge::DriftGauge(const Problem<Mpfr>& problem) : problem_(problem), energy_(problem), point_(problem) {}

StateDrift DriftGauge::operator()(const Vector<Mpfr>& q, const Vector<Mpfr>& p, const Vector<Mpfr>& exact_q,
                                  const Vector<Mpfr>& exact_p) {
  energy_.evaluate(exact_q, exact_p);
  const Mpfr H = energy_.H();
  energy_.evaluate(q, p);
  StateDrift drift;
  drift.H = log10_of(Mpfr(energy_.H() - H)) - log10_of(energy_.size());
  drift.g = of_g(q);
  const Index m = problem_.mass.of_bodies();
  try {
    const Vector<Mpfr> off = p.head(m) - point_.tangential(q, p).head(m);
    drift.hidden = log10_of(max_norm(off)) - log10_of(max_norm(Vector<Mpfr>(p.head(m))));
  } catch (const IntegrationError&) {
    drift.hidden = std::numeric_limits<double>::quiet_NaN();
  }
  return drift;
}

double DriftGauge::of_g(const Vector<Mpfr>& q) {
  return log10_of(max_norm(point_.constraints(q))) - log10_of(point_.constraint_size(q));
}

void DriftGauge::make_consistent(Vector<Mpfr>& q, Vector<Mpfr>& p) {
  // Newton's method: with p = 0 the impulse to the rates g_t - g moves q by M^-1 p in a unit of time.
  constexpr int most = 60;
  const Index m = problem_.mass.of_bodies();
  const Vector<Mpfr> at_rest = Vector<Mpfr>::Zero(problem_.m());
  for (int n = 0; n < most && problem_.nu() > 0; ++n) {
    const Vector<Mpfr> g = point_.constraints(q);
    if (max_norm(g) <= 10 * epsilon<Mpfr>() * point_.constraint_size(q)) break;
    const Vector<Mpfr> rates = point_.hidden_constraints(q, at_rest) - g;
    const Vector<Mpfr> impulse = point_.with_rates(q, at_rest, rates);
    Vector<Mpfr> moved = at_rest;
    problem_.mass.velocity(lanes(impulse), lanes(moved));
    q.head(m) += moved.head(m);
  }
  p = point_.tangential(q, p);
}

std::vector<std::array<double, 2>> growth_of_changes(const Problem<Mpfr>& problem, const Vector<Mpfr>& q0,
                                                     const Vector<Mpfr>& p0, const Mpfr& change,
                                                     const std::vector<Mpfr>& times) {
  const Index m = problem.mass.of_bodies();
  TaylorMotion motion(problem, q0, p0);
  std::deque<TaylorMotion> others;
  for (const int sign : {1, -1}) {
    Vector<Mpfr> q = q0, p = p0;
    q.head(m) *= 1 + change;
    p.head(m) *= 1 + sign * change;
    others.emplace_back(problem, q, p);
  }
  const auto off = [m](const Vector<Mpfr>& x, const Vector<Mpfr>& y) {
    const Vector<Mpfr> of_bodies = x.head(m);
    const Mpfr size = max_norm(of_bodies);
    return size == 0 ? Mpfr(0) : Mpfr(distance(of_bodies, Vector<Mpfr>(y.head(m))) / size);
  };
  std::vector<std::array<double, 2>> grown;
  for (const Mpfr& t : times) {
    motion.advance_to(t);
    std::array<double, 2>& at = grown.emplace_back();
    for (std::size_t i = 0; i < others.size(); ++i) {
      others[i].advance_to(t);
      at[i] = log10_of(std::max(off(motion.q(), others[i].q()), off(motion.p(), others[i].p())));
    }
  }
  return grown;
}

LostBy most_lost_by(const FileComparison& file, double left) {
  const auto of = [](const std::vector<double>& drift) { return drift.empty() ? INFINITY : -drift.back(); };
  const std::array<std::pair<LostBy, double>, 4> parts{
      {{LostBy::g, of(file.g_drift)},
       {LostBy::hidden, of(file.hidden_drift)},
       {LostBy::energy, of(file.H_drift)},
       {LostBy::growth, file.by_growth.size() > 1 ? file.by_growth.back() : INFINITY}}};
  double least = INFINITY;
  for (const auto& part : parts) least = std::min(least, part.second);
  constexpr double near = 1;
  if (least > left + near) return LostBy::motion;
  return std::find_if(parts.begin(), parts.end(), [&](const auto& part) { return part.second <= least + near; })->first;
}

}  // namespace hbvm::core

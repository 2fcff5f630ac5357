#include "compare/lost_digits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>

#include "hbvm/error.hpp"
#include "interruption.hpp"
#include "linear/product.hpp"
#include "reference/taylor.hpp"

namespace hbvm::core {

void end_comparison_if_asked() { end_if_asked("the comparison was not finished"); }

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
  for (int n = 0; problem_.nu() > 0; ++n) {
    const Vector<Mpfr> g = point_.constraints(q);
    if (max_norm(g) <= 10 * epsilon<Mpfr>() * point_.constraint_size(q)) break;
    if (n == most) throw IntegrationError("the state is too far from the constraints");
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
  TaylorMotion motion(problem, q0, p0, end_comparison_if_asked);
  std::deque<TaylorMotion> others;
  for (const int sign : {1, -1}) {
    Vector<Mpfr> q = q0, p = p0;
    q.head(m) *= 1 + change;
    p.head(m) *= 1 + sign * change;
    others.emplace_back(problem, q, p, end_comparison_if_asked);
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

std::array<ErrorPart, 4> parts_of_error(const FileComparison& file) {
  std::array<ErrorPart, 4> parts{{{LostBy::growth, "growth", {}},
                                  {LostBy::g, "g", file.g_drift},
                                  {LostBy::hidden, "hidden", file.hidden_drift},
                                  {LostBy::energy, "H", file.H_drift}}};
  for (ErrorPart& part : parts)
    for (double& log10 : part.digits) log10 = -log10;
  if (file.by_growth.size() > 1) parts.front().digits = file.by_growth;
  return parts;
}

std::string digits_text(double digits) {
  return std::isnan(digits) ? "-" : std::isinf(digits) ? "all" : fmt::format("{:.1f}", digits);
}

LostBy most_lost_by(const FileComparison& file, double left) {
  std::array<ErrorPart, 4> parts = parts_of_error(file);
  const auto at_end = [](const ErrorPart& part) { return part.digits.empty() ? INFINITY : part.digits.back(); };
  double least = INFINITY;
  for (const ErrorPart& part : parts) least = std::min(least, at_end(part));
  constexpr double near = 1;
  if (least > left + near) return LostBy::motion;
  std::rotate(parts.begin(), parts.begin() + 1, parts.end());
  return std::ranges::find_if(parts, [&](const ErrorPart& part) { return at_end(part) <= least + near; })->part;
}

}  // namespace hbvm::core

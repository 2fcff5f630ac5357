#include "reference/closed_form/closed_form.hpp"

#include <algorithm>
#include <numbers>

#include "hbvm/error.hpp"
#include "linear/rounded.hpp"
#include "problem/state_evaluator.hpp"
#include "reference/closed_form/recognition.hpp"
#include "scalar/binary_exponent.hpp"
#include "scalar/text.hpp"

namespace hbvm::core {
namespace {

bool is_finite(const Vector<Mpfr>& x) {
  for (Index j = 0; j < x.size(); ++j)
    if (!hbvm::core::is_finite(x[j])) return false;
  return true;
}

/// Decimal digits between the greatest number and the least that is not 0.
double spread(const Vector<Mpfr>& x) {
  long greatest = exponent_of_zero, least = 0;
  for (Index j = 0; j < x.size(); ++j) {
    if (x[j] == 0) continue;
    const long exponent = binary_exponent(x[j]);
    least = greatest == exponent_of_zero ? exponent : std::min(least, exponent);
    greatest = std::max(greatest, exponent);
  }
  return greatest == exponent_of_zero ? 0
                                      : static_cast<double>(greatest - least) * std::numbers::ln2 / std::numbers::ln10;
}

}  // namespace

ExactPoint ClosedForm::at(const Mpfr& t) const {
  State inner;
  {
    const PrecisionScope scope(digits_);
    inner = state(t);
    if (!is_finite(inner.q) || !is_finite(inner.p))
      throw IntegrationError("the closed form (" + name() + ") has no value at t = " + to_scientific(t, 6));
  }
  ExactPoint point{rounded<Mpfr>(inner.q), rounded<Mpfr>(inner.p), {}};
  StateEvaluator<Mpfr> here(problem_);
  point.lambda = here.multiplier(point.q, point.p);
  return point;
}

std::unique_ptr<ClosedForm> closed_form_of(const Assembled<Mpfr>& scene) {
  if (!scene.problem.redundant.empty() || !scene.problem.is_conservative()) return nullptr;
  const Mpfr round_off = epsilon<Mpfr>();
  // A quantity of the size of round-off is squared, and its square is the difference of others. Three times the digits
  // leave all of its own. So is the least number of the start, where two roots that differ by its square may have half
  // of the digits. The rest is for long times.
  constexpr double rest = 40, most = 20'000;
  const double digits = 3 * static_cast<double>(Mpfr::thread_default_precision()) + rest,
               more = 4 * std::max(spread(scene.q0), spread(scene.p0));
  if (more > most) return nullptr;
  const PrecisionScope scope(static_cast<unsigned>(digits + more));
  const Recognition content(scene, round_off);
  for (const auto recognise :
       {oscillator_of, kepler_of, pendulum_of, spherical_pendulum_of, free_rigid_body_of, symmetric_top_of})
    if (auto motion = recognise(content)) return motion;
  return nullptr;
}

}  // namespace hbvm::core

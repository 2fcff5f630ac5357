#include "hbvm/reference/closed_form/closed_form.hpp"

#include "hbvm/problem/point.hpp"
#include "reference/closed_form/recognition.hpp"

namespace hbvm {
namespace {

Vector<Mpfr> in_this_scope(const Vector<Mpfr>& x) {
  Vector<Mpfr> result(x.size());
  for (Index j = 0; j < x.size(); ++j) result[j] = rounded_to<Mpfr>(raw(x[j]));
  return result;
}

}  // namespace

ExactPoint ClosedForm::at(const Mpfr& t) const {
  State inner;
  {
    const PrecisionScope scope(digits_);
    inner = state(t);
  }
  ExactPoint point{in_this_scope(inner.q), in_this_scope(inner.p), {}};
  Point<Mpfr> here(problem_);
  point.lambda = here.multiplier(point.q, point.p);
  return point;
}

std::unique_ptr<ClosedForm> closed_form_of(const Assembled<Mpfr>& scene) {
  if (!scene.problem.redundant.empty()) return nullptr;
  const Mpfr round_off = epsilon<Mpfr>();
  // A quantity of the size of round-off is squared, and its square is the difference of others: three times the digits
  // leave all of its own. The rest is for long times.
  constexpr unsigned rest = 40;
  const PrecisionScope scope(3 * Mpfr::thread_default_precision() + rest);
  const Recognition content(scene, round_off);
  for (const auto recognise :
       {oscillator_of, kepler_of, pendulum_of, spherical_pendulum_of, free_rigid_body_of, symmetric_top_of})
    if (auto motion = recognise(content)) return motion;
  return nullptr;
}

}  // namespace hbvm

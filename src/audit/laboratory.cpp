#include "laboratory.hpp"

#include "reference/taylor.hpp"
#include "step/hbvm_method.hpp"
#include "step/rattle.hpp"

namespace hbvm::core {

Laboratory::Laboratory(const ClaimGroup& group) : assembled_(assemble<Mpfr>(load_scene(group.subject().problem))) {
  point_.emplace(assembled_.problem);
  walk(group);
}

Mpfr Laboratory::apart(const Vector<Mpfr>& a, const Vector<Mpfr>& b) const {
  const Index bodies = problem().mass.of_bodies();
  return distance(Vector<Mpfr>(a.head(bodies)), Vector<Mpfr>(b.head(bodies)));
}

std::optional<ExactPoint> Laboratory::known(const Start& start, const Mpfr& t) const {
  Assembled<Mpfr> from = assembled_;
  from.q0 = start.q;
  from.p0 = start.p;
  const std::unique_ptr<ClosedForm> motion = closed_form_of(from);
  return motion ? std::optional(motion->at(t)) : std::nullopt;
}

bool Laboratory::take(const Vector<Mpfr>& q, const Vector<Mpfr>& p, long steps, const Starts& wanted) {
  if (steps >= wanted.lead && (steps - wanted.lead) % wanted.stride == 0)
    starts_.push_back({q, point_->tangential(q, p)});
  return static_cast<int>(starts_.size()) == wanted.count;
}

void Laboratory::walk(const ClaimGroup& group) {
  const Mpfr h = ldexp(Mpfr(1), group.log2_scale - 3);
  if (!problem().is_conservative()) {
    // No method keeps g = 0 where a point moves. The exact motion does.
    TaylorMotion motion(problem(), assembled_.q0, assembled_.p0, [&] { group.check_time(); });
    for (long n = 0; !take(motion.q(), motion.p(), n, group.starts); ++n) motion.advance_to((n + 1) * h);
    return;
  }
  // Any point of a motion that keeps g = 0 will do, once its momentum is projected: it need not be the exact motion. If
  // g is quadratic HBVM keeps it whatever the step, and RATTLE any other.
  const MethodPtr method = degree_of_g(problem()) == 2 ? hbvm_of({4, 4}) : rattle_method();
  const std::unique_ptr<Stepper<Mpfr>> stepper = method->make_stepper(problem(), SolverKind::automatic);
  State<Mpfr> state(assembled_.q0, assembled_.p0);
  for (long n = 0; !take(state.q, state.p, n, group.starts); ++n) {
    stepper->step(state, h);
    group.check_time();
  }
}

}  // namespace hbvm::core

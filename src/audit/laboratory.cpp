#include "laboratory.hpp"

#include "hbvm/error.hpp"
#include "step/hbvm_method.hpp"
#include "step/rattle.hpp"

namespace hbvm::core {

Laboratory::Laboratory(const ClaimGroup& group) : assembled_(assemble<Mpfr>(load_scene(group.subject().problem))) {
  if (!assembled_.problem.driven.empty())
    throw InputError("'" + group.subject().problem +
                     "': claims are about motions that conserve H; here work is done, or t stands in the scene");
  point_.emplace(assembled_.problem);
  walk(group);
}

std::optional<ExactPoint> Laboratory::known(const Start& start, const Mpfr& t) const {
  Assembled<Mpfr> from = assembled_;
  from.q0 = start.q;
  from.p0 = start.p;
  const std::unique_ptr<ClosedForm> motion = closed_form_of(from);
  return motion ? std::optional(motion->at(t)) : std::nullopt;
}

void Laboratory::walk(const ClaimGroup& group) {
  // Any point of a motion that keeps g = 0 will do, once its momentum is projected: it need not be the exact motion. If
  // g is quadratic HBVM keeps it whatever the step, and RATTLE any other.
  const MethodPtr method = degree_of_g(assembled_.problem) == 2 ? hbvm_of({4, 4}) : rattle_method();
  const std::unique_ptr<Stepper<Mpfr>> stepper = method->make_stepper(assembled_.problem, SolverKind::automatic);
  const Mpfr h = ldexp(Mpfr(1), group.log2_scale - 3);
  State<Mpfr> state(assembled_.q0, assembled_.p0);
  const Starts& wanted = group.starts;
  for (long n = 0;; ++n) {
    if (n >= wanted.lead && (n - wanted.lead) % wanted.stride == 0)
      starts_.push_back({state.q, point_->tangential(state.q, state.p)});
    if (static_cast<int>(starts_.size()) == wanted.count) return;
    stepper->step(state, h);
    group.check_time();
  }
}

}  // namespace hbvm::core

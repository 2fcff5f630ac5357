#pragma once

#include "run/run_request.hpp"
#include "run/simulate.hpp"

namespace hbvm::core {

/// Digits of a run beside one in S, with which that is compared: 16 more.
template <Scalar S>
unsigned digits_of_a_run_beside() {
  constexpr unsigned more = 16;
  if constexpr (std::same_as<S, double>) return 16 + more;
  if constexpr (std::same_as<S, Quad>) return 34 + more;
  return static_cast<unsigned>(digits10<S>()) + more;
}

template <Scalar S>
Vector<Mpfr> exact_vector(const Vector<S>& x) {
  return x.unaryExpr([](const S& entry) { return rounded_to<Mpfr>(raw(exactly(entry))); });
}

/// What a state stands for: its numbers with the carry that belongs to them, which more digits hold.
template <Scalar S>
State<Mpfr> exact_state(const State<S>& state) {
  return {exact_vector<S>(state.q) + exact_vector<S>(state.q_carry),
          exact_vector<S>(state.p) + exact_vector<S>(state.p_carry)};
}

/// The run of a request by this method in the current precision of Mpfr, from the exact scene, or from `start`.
/// \throws InputError, IntegrationError
template <Scalar S>
Simulated<Mpfr> run_beside(const RunRequest& request, const Method& method, const std::optional<State<S>>& start,
                           const std::vector<Observer<Mpfr>*>& observers = {}) {
  const TimeGrid<Mpfr> grid(request.step, request.until, request.scene.constants, request.direction,
                            LastStep::shortened);
  const Assembled<Mpfr> scene = assemble<Mpfr>(request.scene);
  const std::unique_ptr<Stepper<Mpfr>> stepper = method.make_stepper(scene.problem, request.solver);
  Course<Mpfr> course;
  if (start) course.start = exact_state(*start);
  return simulate<Mpfr>(scene, *stepper, grid, observers, nullptr, nullptr, course);
}

}  // namespace hbvm::core

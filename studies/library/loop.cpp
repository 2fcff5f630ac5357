#include <hbvm/core/scalar/text.hpp>
#include <hbvm/core/scene/assemble.hpp>
#include <hbvm/core/step/registry.hpp>
#include <iostream>

// A loop of one's own: steps until the bob has turned back, in 50 digits.
int main() {
  using namespace hbvm::core;
  const PrecisionScope digits(50);
  const auto scene = assemble<Mpfr>(load_scene("simple_pendulum"));
  const auto stepper = parse_method("hbvm:3,3")->make_stepper<Mpfr>(scene.problem, SolverKind::automatic);
  State<Mpfr> state{scene.q0, scene.p0};
  const Mpfr h = Mpfr(1) / 64;
  long steps = 0;
  for (const bool right = state.p[0] > 0; (state.p[0] > 0) == right || steps < 2; ++steps) stepper->step(state, h);
  std::cout << "it turned back before t = " << to_text(Mpfr(h * steps)) << ", at x = " << to_text(state.q[0]) << '\n';
}

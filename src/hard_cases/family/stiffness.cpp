#include <fmt/format.h>

#include "hard_cases/family.hpp"
#include "hard_cases/scenes.hpp"
#include "problem/state_evaluator.hpp"
#include "scalar/literal.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {
namespace {

/// Accuracy, and the energy. With steps much longer than its period, a spring of stiffness k is stretched by what the
/// chords of the motion differ from it. That is (h v)^2/2 with v^2 = 2 |H| for masses and lengths of 1. The spring
/// holds half k times the square of that. On a wrong root of the stage equations the energy is greater by orders, in
/// any number of digits.
CaseResult on_the_right_root(const RunRequest& request) {
  CaseResult result = accuracy(request);
  if (!result.failure.empty()) return result;
  const double e_H = evaluate<double>(Expression::parse(run(request, {}).e_H));
  const Assembled<double> scene = assemble<double>(request.scene);
  const double size = StateEvaluator<double>(scene.problem).energy_size(scene.q0, scene.p0);
  double stiffness = 0;
  for (const SceneEffect& effect : request.scene.effects)
    if (effect.kind == "spring") stiffness = evaluate<double>(effect.numbers.at("stiffness"));
  const double h = evaluate<double>(request.step), stretch = h * h * size;
  result.criteria.push_back({"e_H over the terms of H", e_H / size, 1 + stiffness * stretch * stretch / 2 / size});
  return result;
}

}  // namespace

void add_stiffness(const Family& family) {
  // Sweeps have a limit, which is reached in seconds.
  const double seconds = family.full() ? 30 : 5;
  const Expected either = holds_or({"stage_equations_diverge"});
  for (const std::string k : {"1e8", "1e12"})
    for (int i = 3; i <= 9; ++i) {
      if (!family.full() && i % 3 != 0) continue;
      family.add_run(
          "body on a spring", "stiffness " + k, all_precisions, either, [k] { return spring_pendulum(k); },
          {"hbvm:2,2", "auto", fmt::format("2^(-{})", i), i == 3 ? "1" : "1/4"}, on_the_right_root, seconds);
    }
  for (const std::string solver : {"auto", "newton", "fixed-point"})
    family.add_run(
        "body on a spring", "stiffness 1e8", {"mpfr:50"}, either, [] { return spring_pendulum("1e8"); },
        {"hbvm:6,2", solver, "1/8", "1"}, on_the_right_root, seconds);
  family.add_run(
      "spring on a pendulum", "stiffness 1e8", all_precisions, either, [] { return pendulum_with_spring("1e8"); },
      {"hbvm:1,1", "auto", "1/32", "1"}, on_the_right_root, seconds);
  // Gauss methods are unconditionally stable: omega h from 1 to 1000.
  for (const std::string omega : {"1", "10", "100", "1000"})
    for (const std::string method : {"hbvm:1,1", "hbvm:3,3"})
      for (const std::string solver : {"auto", "newton"}) {
        if (!family.full() && omega != "1000") continue;
        family.add_run("linear oscillator", "omega h = " + omega, all_precisions, holds(),
                       [omega] { return oscillator(omega + "^2"); }, {method, solver, "1", "64"});
      }
}

}  // namespace hbvm::core

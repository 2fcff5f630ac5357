#include <hbvm/hbvm.hpp>
#include <iostream>

// A weight on a rod, with a spring to a peg beside it. How well is H conserved, and where is the weight?
int main() {
  hbvm::Scene scene(2, "weight");
  scene.title("A weight on a rod and a spring").constant("L", "3/2");
  scene.point("pivot", {0, 0}).point("peg", {2, "-1/2"});
  scene.body({.name = "weight", .mass = 2, .position = {"3*L/5", "-4*L/5"}}).rod("pivot", "weight", "L");
  scene.effect({.kind = "uniform_gravity", .vectors = {{"acceleration", {0, "-9.81"}}}});
  scene.effect({.kind = "formula", .center = "peg", .on = {"weight"}, .U = "-5*(r - 1)^2/2"});

  const hbvm::Run run = hbvm::run({.scene = scene, .method = "hbvm:auto,3", .step = "1/32", .until = 10});
  std::cout << run.method << ": H changed by " << run.e_H << '\n';
  const std::vector<double> t = run.trajectory.values("t"), x = run.trajectory.values("weight.x");
  for (std::size_t i = 0; i < t.size(); i += 64) std::cout << t[i] << ' ' << x[i] << '\n';
  for (const hbvm::Warning& warning : run.health.warnings) std::cout << warning.name << ": " << warning.text << '\n';
}

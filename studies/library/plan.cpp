#include <hbvm/hbvm.hpp>
#include <iostream>

// What is the cheapest run of the double pendulum to t = 5 with 12 right digits?
int main() {
  const hbvm::Plan plan = hbvm::plan(
      {.scene = hbvm::load_scene("double_pendulum"), .until = 5, .digits = 12, .methods = {"gauss", "auto"}});
  std::cout << plan.pick.method << " with steps of " << plan.pick.step << " in " << plan.pick.precision << ": error 1e"
            << *plan.pick.error << " in " << *plan.pick.seconds << " s\n";
}

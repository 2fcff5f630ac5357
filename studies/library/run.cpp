#include <hbvm/hbvm.hpp>
#include <iostream>

// How well is the energy conserved? All numbers have 50 digits.
int main() {
  const hbvm::Run run = hbvm::run({.scene = hbvm::load_scene("modified_pendulum"),
                                   .method = "hbvm:4,2",
                                   .step = "1/16",
                                   .until = 20,
                                   .precision = "mpfr:50"});
  std::cout << "energy error " << run.e_H << ", x at the end " << run.trajectory.text("bob.x").back() << '\n'
            << hbvm::to_json(run) << '\n';
}

#include <hbvm/hbvm.hpp>
#include <iostream>

// Where is the planet at t = 10, to 50 digits?
int main() {
  const hbvm::Reference found = hbvm::reference({.scene = hbvm::load_scene("kepler"), .times = {5, 10}, .digits = 50});
  for (const hbvm::ReferenceState& state : found.times)
    std::cout << "t = " << state.t << ": x = " << state.q[0] << ", the routes agree in " << state.agreed << " digits\n";
}

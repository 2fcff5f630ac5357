#include <iostream>

#include "hbvm/core/run/simulate.hpp"
#include "hbvm/core/scalar/text.hpp"

int main() {
  using namespace hbvm;
  const PrecisionScope digits(50);
  const auto scene = assemble<Mpfr>(load_scene("modified_pendulum"));
  const auto method = make_hbvm<Mpfr>(4, 2);
  const TimeGrid<Mpfr> grid(Expression::parse("1/16"), Expression::parse("20"));
  const auto result = simulate(scene, method, SolverKind::automatic, grid);
  std::cout << "energy error " << to_text(result.e_H) << '\n';
}

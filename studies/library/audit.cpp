#include <hbvm/hbvm.hpp>
#include <iostream>

// Are these coefficients of order 4, as their author says? One digit of b is wrong.
int main() {
  const hbvm::Tableau kutta{.name = "Kutta's",
                            .A = {{0, 0, 0, 0}, {"1/2", 0, 0, 0}, {0, "1/2", 0, 0}, {0, 0, 1, 0}},
                            .b = {"1/6", "1/3", "1/3", "1/7"},
                            .c = {0, "1/2", "1/2", 1},
                            .order = 4};
  const hbvm::Audit audit = hbvm::audit(hbvm::tableau_claims(kutta));
  std::cout << audit.summary << '\n';
  for (const hbvm::Finding& finding : audit.findings)
    if (finding.verdict == "fails") std::cout << finding.quantity << ": " << finding.reason << '\n';
}

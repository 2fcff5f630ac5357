#include "problem/force_term.hpp"

namespace hbvm::core {

template <Scalar S>
ForceTerm<double> in_double(const ForceTerm<S>& term) {
  ForceTerm<double> result{term.kind,
                           term.name,
                           term.arguments,
                           term.acting,
                           {},
                           in_double(term.force),
                           in_double(term.slopes),
                           in_double(term.force_coefficients),
                           in_double(term.slope_coefficients),
                           term.account};
  for (const Displacement<S>& x : term.displacements) result.displacements.push_back(in_double(x));
  return result;
}

#define HBVM_DEFINE(S) template ForceTerm<double> in_double<S>(const ForceTerm<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

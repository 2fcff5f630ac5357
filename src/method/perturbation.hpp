#pragma once

#include "method/hbvm.hpp"
#include "scalar/expression.hpp"

namespace hbvm::core {

/// One number of HBVM(k, s) made wrong on purpose, to see what notices: x becomes x (1 + relative). What is computed
/// from the number follows it, as it would if the mistake were in a program.
struct Perturbation {
  enum class Part {
    node,      ///< c_i, and so row i of P_s and I_s
    weight,    ///< b_i
    integral,  ///< int_0^{c_i} P_j alone
    X,         ///< entry (i, j) of X_s alone
    legendre   ///< the coefficient of c^j in P_i, and so column i of the values and integrals
  };
  Part part;
  bool hat = false;  ///< of the k nodes of the potential's integrals, not of the r of the constraints
  int i = 0, j = 0;  ///< counted from 0
  Expression relative;
};

/// For k = r, where both sets of nodes are one, both are changed.
/// \throws InputError if there is no such number, or it is 0
template <Scalar S>
void perturb(Hbvm<S>& method, const Perturbation& perturbation);

}  // namespace hbvm::core

#pragma once

#include <string>

#include "scene/assemble.hpp"
#include "step/hbvm_stepper.hpp"
#include "step/raising_stepper.hpp"

namespace hbvm::core {

/// The numbers of nodes that hbvm:auto,S stands for, and why.
struct ChosenK {
  int k = 0;
  std::string reason;
  bool exact = false;         ///< for every motion: U and g are polynomials
  int r = 0;                  ///< of the constraints; 0, which is s, if all are quadratic
  Raises raises = Raises::k;  ///< what may have to be raised later
};

/// Degree of U as a polynomial in q; nothing if it is none. 0 without effects.
template <Scalar S>
std::optional<int> degree_of_U(const Problem<S>& problem);

/// For a polynomial U of degree mu the least k >= s that integrates it exactly, k >= mu s/2, (51). Otherwise the least
/// k for which psi_hat agrees with that of k + s to round-off, at the solutions of the first 16 steps. If no k makes
/// that many steps, the one that comes farthest. Likewise r, unless the name says it: r >= d s/2 for polynomial g of
/// degree d. For other g these steps must move g by round-off: r is as many nodes as k, or the least if U is a
/// polynomial. \throws InputError if no k up to max_k will do, StepError if no k makes the first step
template <Scalar S>
ChosenK choose_k(const Assembled<S>& scene, const HbvmName& name, const S& step, SolverKind solver);

/// The QuadratureDefect of the step that starts from (q, p): at most 1 if more nodes would change nothing.
template <Scalar S>
S quadrature_defect(const Problem<S>& problem, int k, int s, const S& step, SolverKind solver, const Vector<S>& q,
                    const Vector<S>& p);

}  // namespace hbvm::core

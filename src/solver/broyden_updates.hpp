#pragma once

#include <vector>

#include "solver/stage_equations.hpp"

namespace hbvm::core {

/// Updates of rank one of a Jacobian that is kept: each correction shows something of it, and improves those after it.
/// It is Broyden's good update in the form of corrections (Kelley, Iterative Methods for Linear and Nonlinear
/// Equations, 1995, section 7.3). The `momentum` of a correction is a change of gamma, its `constraint` one of h
/// lambda.
template <Scalar S>
class BroydenUpdates {
 public:
  /// So many corrections are kept. If updates make a Jacobian as good as a new one at all, as many do.
  static constexpr std::size_t most = 16;

  /// \param used whether there are any updates
  BroydenUpdates(const StageResidual<S>& like, bool used);

  bool used() const { return !kept_.empty(); }
  /// Forgets all corrections: the Jacobian or the iteration is a new one.
  void clear() { known_ = 0; }
  /// Makes a correction by the Jacobian one by the updated Jacobian. Coordinates are in units of `scale`.
  void update(StageResidual<S>& correction, const Vector<S>& scale);
  /// Keeps a correction that is made. One that is `small` is rounding and shows nothing: all are forgotten.
  void keep(const StageResidual<S>& correction, const Vector<S>& scale, bool small);

 private:
  /// The product of the momenta of two corrections.
  S product(const StageResidual<S>& a, const StageResidual<S>& b, const Vector<S>& scale);

  std::vector<StageResidual<S>> kept_;
  std::vector<S> squares_;  ///< of each with itself
  std::size_t known_ = 0;   ///< how many there are now
  S t_ = 0, u_ = 0;
};

}  // namespace hbvm::core

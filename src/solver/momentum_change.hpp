#pragma once

#include "hbvm/error.hpp"
#include "linear/lu.hpp"
#include "method/hbvm.hpp"
#include "scalar/in_place.hpp"

namespace hbvm::core {

/// What Newton's last correction changes of the momentum p1 - p0 = h (psi_0 - zeta_0). By (54) gamma - e_1 p0 is
/// h X_s (psi - zeta), so that it is row 0 of X_s^-1 (residual - correction) when gamma changes by -correction.
template <Scalar S>
class MomentumChange {
 public:
  explicit MomentumChange(const Hbvm<S>& method) : row_(Vector<S>::Unit(method.s, 0)) {
    Lu<S> lu;
    lu.set(method.X_s.transpose());
    if (!lu.factor()) throw InputError("X_s is singular");
    lu.solve(row_);
  }

  /// \param residual of the stage equations (54), before the correction
  void add(const Matrix<S>& residual, const Matrix<S>& correction, Vector<S>& change) const {
    S t;
    for (Index j = 0; j < change.size(); ++j)
      for (Index i = 0; i < row_.size(); ++i) add_product(change[j], row_[i], S(residual(i, j) - correction(i, j)), t);
  }

 private:
  Vector<S> row_;  ///< of X_s^-1
};

}  // namespace hbvm::core

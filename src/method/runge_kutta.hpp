#pragma once

#include "hbvm/method.hpp"
#include "linear/matrix.hpp"

namespace hbvm::core {

/// A tableau in one precision: K_i = f(t_0 + c_i h, y_0 + h sum_j A_ij K_j), y_1 = y_0 + h sum_i b_i K_i.
template <Scalar S>
struct RungeKutta {
  Matrix<S> A;
  Vector<S> b, c;

  int stages() const { return static_cast<int>(b.size()); }
};

/// Every entry is rounded once.
/// \throws InputError naming the entry, "A[2][1]" (from 1), that has no value; if A is not s x s, b and c not s long,
///         or s < 1
template <Scalar S>
RungeKutta<S> make_runge_kutta(const Tableau& tableau);

}  // namespace hbvm::core

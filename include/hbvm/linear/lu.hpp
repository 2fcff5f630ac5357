#pragma once

#include <vector>

#include "hbvm/linear/matrix.hpp"

namespace hbvm {

/// P a = L U with partial pivoting, for a small dense matrix in the working precision. Storage is kept from one
/// factorisation to the next.
template <Scalar S>
class Lu {
 public:
  /// The matrix to be filled, n x n; factor() overwrites it.
  Matrix<S>& matrix() { return lu_; }

  /// \return false if a pivot is 0 or not finite: the matrix is singular to working precision
  [[nodiscard]] bool factor();

  /// x = a^-1 x.
  void solve(Vector<S>& x);

 private:
  Matrix<S> lu_;
  std::vector<Index> pivots_;
};

#define HBVM_DECLARE(S) extern template class Lu<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DECLARE)
#undef HBVM_DECLARE

}  // namespace hbvm

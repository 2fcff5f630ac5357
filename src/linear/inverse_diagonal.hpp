#pragma once

#include <vector>

#include "linear/index.hpp"
#include "scalar/scalar.hpp"

namespace hbvm::core {

/// The diagonal of the inverse of a symmetric positive definite matrix with all entries a_ij, |i - j| > b, zero. First
/// A = L D L^T is found without pivoting. Then rows are taken from the last to the first (Takahashi, Fagan and Chin
/// 1973). A^-1 = D^-1 L^-1 + (I - L^T) A^-1 tells the entries within the band. It takes O(n b^2) operations, and
/// storage is kept.
///
/// For a Gram matrix of unit vectors, entry a is 1/sin^2 of an angle: that between vector a and the span of all the
/// others.
template <Scalar S>
class InverseDiagonal {
 public:
  /// An n x n matrix of zeros, to be filled by entry(); half_bandwidth is cut to n - 1.
  void resize(Index n, Index half_bandwidth);
  void set_zero();
  Index size() const { return n_; }

  /// a_ij for 0 <= i - j <= half_bandwidth. compute() overwrites them all.
  S& entry(Index i, Index j) { return a_[static_cast<std::size_t>(i - j + j * (b_ + 1))]; }

  /// \return false if a pivot is not positive: the matrix is singular to working precision
  [[nodiscard]] bool compute();

  /// (A^-1)_ii, after compute().
  const S& operator[](Index i) const { return inverse_[static_cast<std::size_t>(i * (b_ + 1))]; }

 private:
  S& inverse(Index i, Index j) { return inverse_[static_cast<std::size_t>(i - j + j * (b_ + 1))]; }

  Index n_ = 0, b_ = 0;
  std::vector<S> a_, inverse_;  // column j holds rows j .. j + b
};

}  // namespace hbvm::core

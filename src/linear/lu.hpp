#pragma once

#include <vector>

#include "linear/matrix.hpp"
#include "linear/operation_counts.hpp"
#include "scalar/archive.hpp"

namespace hbvm::core {

/// P a = L U with partial pivoting in the working precision. The matrix is square, with all entries a_ij, |i - j| > b,
/// zero for a half bandwidth b; b = n - 1 is a dense one. It takes O(n b^2) operations, and O(n b) to solve. Storage is
/// kept from one factorisation to the next. A large dense matrix in double is factored block by block. Of the pivots
/// the reciprocals are kept, so that to solve takes no division.
template <Scalar S>
class Lu {
 public:
  /// An n x n matrix, to be filled by entry(); half_bandwidth is cut to n - 1.
  void resize(Index n, Index half_bandwidth);
  void set_zero();
  /// The matrix itself, dense.
  void set(const Matrix<S>& a);

  Index size() const { return n_; }
  Index half_bandwidth() const { return b_; }

  /// a_ij, for |i - j| <= half_bandwidth. factor() may overwrite them all.
  S& entry(Index i, Index j) { return data_[static_cast<std::size_t>(offset_ + i + j * stride_)]; }

  /// \return false if a pivot is 0 or not finite: the matrix is singular to working precision
  [[nodiscard]] bool factor();

  /// x = a^-1 x.
  void solve(Vector<S>& x) { solve(x.data()); }
  void solve(S* x);

  /// The products, quotients and differences of one factorisation, and of one solution, at most (zeros are not known).
  OperationCounts factor_operations() const;
  OperationCounts solve_operations() const;

  /// The factors; for a matrix of the same size.
  void remember(Archive& archive);

 private:
  /// \return false if a reciprocal is not finite
  [[nodiscard]] bool invert_pivots();

  // Column j holds rows j - 2 b .. j + b: pivoting fills in b diagonals above the band. A dense matrix has no more.
  Index n_ = 0, b_ = 0, upper_ = 0, stride_ = 0, offset_ = 0;
  std::vector<S> data_;
  std::vector<Index> pivots_;  // of few unknowns in double the rows in their new order
  bool blocked_ = false;
  S one_ = 1;
};

}  // namespace hbvm::core

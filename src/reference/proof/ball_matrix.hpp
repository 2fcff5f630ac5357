#pragma once

#include "linear/index.hpp"
#include "scalar/arb.hpp"

namespace hbvm::core {

/// A matrix of balls.
class BallMatrix {
 public:
  BallMatrix() : BallMatrix(0, 0) {}
  BallMatrix(Index rows, Index columns) { arb_mat_init(value_, rows, columns); }
  BallMatrix(const BallMatrix& other) : BallMatrix(other.rows(), other.columns()) { arb_mat_set(value_, other.value_); }
  BallMatrix(BallMatrix&& other) noexcept : BallMatrix(0, 0) { arb_mat_swap(value_, other.value_); }
  BallMatrix& operator=(BallMatrix other) noexcept {
    arb_mat_swap(value_, other.value_);
    return *this;
  }
  ~BallMatrix() { arb_mat_clear(value_); }

  Index rows() const { return arb_mat_nrows(value_); }
  Index columns() const { return arb_mat_ncols(value_); }
  arb_ptr operator()(Index i, Index j) { return arb_mat_entry(value_, i, j); }
  arb_srcptr operator()(Index i, Index j) const { return arb_mat_entry(value_, i, j); }
  RealBall at(Index i, Index j) const {
    RealBall x;
    arb_set(raw(x), (*this)(i, j));
    return x;
  }
  void set(Index i, Index j, const RealBall& x) { arb_set((*this)(i, j), raw(x)); }
  void add(Index i, Index j, const RealBall& x) { arb_add((*this)(i, j), (*this)(i, j), raw(x), BallScope::bits()); }

  friend BallMatrix operator*(const BallMatrix& a, const BallMatrix& b) {
    BallMatrix r(a.rows(), b.columns());
    arb_mat_mul(r.value_, a.value_, b.value_, BallScope::bits());
    return r;
  }
  friend BallMatrix operator-(const BallMatrix& a, const BallMatrix& b) {
    BallMatrix r(a.rows(), a.columns());
    arb_mat_sub(r.value_, a.value_, b.value_, BallScope::bits());
    return r;
  }
  friend BallMatrix operator+(const BallMatrix& a, const BallMatrix& b) {
    BallMatrix r(a.rows(), a.columns());
    arb_mat_add(r.value_, a.value_, b.value_, BallScope::bits());
    return r;
  }
  BallMatrix transposed() const {
    BallMatrix r(columns(), rows());
    arb_mat_transpose(r.value_, value_);
    return r;
  }
  /// r = the inverse. \return whether each matrix between the bounds is known to have one
  bool invert(BallMatrix& r) const {
    r = BallMatrix(rows(), rows());
    return arb_mat_inv(r.value_, value_, BallScope::bits()) != 0;
  }
  /// r = a matrix without radii that is near the inverse, of which nothing is known. \return whether one was found
  bool invert_approximately(BallMatrix& r) const {
    r = BallMatrix(rows(), rows());
    return arb_mat_approx_inv(r.value_, value_, BallScope::bits()) != 0;
  }
  /// x = the inverse times b. \return whether each matrix between the bounds is known to have one
  bool solve(const BallMatrix& b, BallMatrix& x) const {
    x = BallMatrix(b.rows(), b.columns());
    return arb_mat_solve(x.value_, value_, b.value_, BallScope::bits()) != 0;
  }
  /// r = the lower triangle L with L L^T equal to this. \return whether this is known to be positive definite
  bool factor(BallMatrix& r) const {
    r = BallMatrix(rows(), rows());
    return arb_mat_cho(r.value_, value_, BallScope::bits()) != 0;
  }

 private:
  arb_mat_t value_;
};

}  // namespace hbvm::core

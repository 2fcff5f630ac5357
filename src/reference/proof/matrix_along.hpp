#pragma once

#include "ball_matrix.hpp"

namespace hbvm::core {

/// A matrix that changes in time: its values, and its derivatives if they are asked for.
struct MatrixAlong {
  MatrixAlong(Index rows, Index columns, bool with_rate)
      : value(rows, columns), rate(with_rate ? rows : 0, with_rate ? columns : 0) {}
  MatrixAlong(BallMatrix of_value, BallMatrix of_rate) : value(std::move(of_value)), rate(std::move(of_rate)) {}

  bool has_rate() const { return rate.rows() > 0; }
  /// Adds to an entry a number and its derivative.
  void add(Index i, Index j, const RealBall& x, const RealBall& dx) {
    value.add(i, j, x);
    if (has_rate()) rate.add(i, j, dx);
  }
  MatrixAlong transposed() const { return {value.transposed(), rate.transposed()}; }
  friend MatrixAlong operator+(const MatrixAlong& a, const MatrixAlong& b) {
    return {a.value + b.value, a.rate + b.rate};
  }
  friend MatrixAlong operator-(const MatrixAlong& a, const MatrixAlong& b) {
    return {a.value - b.value, a.rate - b.rate};
  }
  friend MatrixAlong operator*(const MatrixAlong& a, const MatrixAlong& b) {
    return {a.value * b.value, a.has_rate() ? a.rate * b.value + a.value * b.rate : BallMatrix()};
  }
  friend MatrixAlong operator*(const BallMatrix& a, const MatrixAlong& b) {
    return {a * b.value, b.has_rate() ? a * b.rate : BallMatrix()};
  }
  friend MatrixAlong operator*(const MatrixAlong& a, const BallMatrix& b) {
    return {a.value * b, a.has_rate() ? a.rate * b : BallMatrix()};
  }
  /// r = the inverse. \return whether each matrix between the bounds is known to have one
  bool invert(MatrixAlong& r) const {
    if (!value.invert(r.value)) return false;
    r.rate = BallMatrix();
    if (has_rate()) r.rate = BallMatrix(rate.rows(), rate.columns()) - r.value * rate * r.value;
    return true;
  }

  BallMatrix value, rate;
};

}  // namespace hbvm::core

#pragma once

#include <vector>

#include "reference/proof/ball_matrix.hpp"

namespace hbvm::core {

/// Where an error may be, as it is moved by one linear map after another: A r, for all r between bounds. A box would
/// grow with each turn. So A turns with the errors: its columns are nearly orthonormal, the longest errors first (R.
/// Lohner, 1988). Any regular A proves the same, if less tightly.
class ErrorFrame {
 public:
  /// A column of errors between bounds. \param units  powers of two, in which components are compared
  ErrorFrame(const BallMatrix& error, std::vector<double> units);

  /// Bounds of each component.
  BallMatrix hull() const { return A_ * r_; }
  /// An error e becomes M e + added.
  void map(const BallMatrix& M, const BallMatrix& added);

 private:
  std::vector<double> units_;
  BallMatrix A_, r_;
};

}  // namespace hbvm::core

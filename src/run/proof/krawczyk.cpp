#include "krawczyk.hpp"

namespace hbvm::core {

RealBall size_of(const BallMatrix& column, const std::vector<RealBall>& units) {
  RealBall size;
  for (Index i = 0; i < column.rows(); ++i) {
    const RealBall entry = column.at(i, 0) / units[static_cast<std::size_t>(i)];
    if (!entry.is_finite()) return entry;  // no size is below another then
    size = greater(size, greatest_magnitude(entry));
  }
  return size;
}

Krawczyk::Krawczyk(const BallMatrix& J, const BallMatrix& residual, const std::vector<RealBall>& units,
                   const RealBall& radius) {
  BallMatrix Y;
  if (!J.invert_approximately(Y)) return;
  const RealBall correction = size_of(Y * residual, units);
  // |1 - Y J| is the size of what it makes of a column of units with signs at their worst.
  const BallMatrix Y_J = Y * J;
  BallMatrix row_sums(J.rows(), 1);
  for (Index i = 0; i < J.rows(); ++i)
    for (Index j = 0; j < J.rows(); ++j)
      row_sums.add(i, 0,
                   greatest_magnitude(Y_J.at(i, j) - RealBall(i == j ? 1 : 0)) * units[static_cast<std::size_t>(j)]);
  const RealBall contraction = size_of(row_sums, units);
  proves_ = (correction + contraction * radius).is_below(radius);
  if (proves_) distance_ = greatest_magnitude(correction / (RealBall(1) - contraction));
}

}  // namespace hbvm::core

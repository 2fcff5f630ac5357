#include "error_frame.hpp"

#include <Eigen/QR>

#include "hbvm/error.hpp"

namespace hbvm::core {
namespace {

/// The greatest magnitudes of a column, in units of the greatest of them, or of 1.
Eigen::VectorXd relative_sizes(const BallMatrix& column) {
  RealBall most;
  for (Index i = 0; i < column.rows(); ++i) most = greater(most, greatest_magnitude(column.at(i, 0)));
  if (!most.is_positive()) most = 1;
  Eigen::VectorXd sizes(column.rows());
  for (Index i = 0; i < column.rows(); ++i) sizes[i] = centre_of(raw(greatest_magnitude(column.at(i, 0)) / most));
  return sizes;
}

}  // namespace

ErrorFrame::ErrorFrame(const BallMatrix& error, std::vector<double> units)
    : units_(std::move(units)), A_(error.rows(), error.rows()), r_(error) {
  for (Index i = 0; i < error.rows(); ++i) A_.set(i, i, 1);
}

void ErrorFrame::map(const BallMatrix& M, const BallMatrix& added) {
  const Index n = A_.rows();
  const BallMatrix turned = M * A_;
  const Eigen::VectorXd sizes = relative_sizes(r_);
  Eigen::MatrixXd edges(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j)
      edges(i, j) = centre_of(turned(i, j)) * sizes[j] / units_[static_cast<std::size_t>(i)];
  if (!edges.allFinite()) throw IntegrationError("bounds of errors are not finite");
  const Eigen::MatrixXd Q = Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(edges).householderQ();
  BallMatrix inverse;
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) A_.set(i, j, exact_ball(Q(i, j) * units_[static_cast<std::size_t>(i)]));
  if (!A_.invert(inverse)) throw IntegrationError("a frame of errors cannot be told from a singular one");
  r_ = inverse * turned * r_ + inverse * added;
}

}  // namespace hbvm::core

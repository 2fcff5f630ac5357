#include "scene/second_moment.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "hbvm/error.hpp"
#include "scalar/scalar.hpp"

namespace hbvm::core {
namespace {

template <Scalar S>
Matrix<S> of_the_center(const MassDistribution<S>& of) {
  Matrix<S> result(of.center.size(), of.center.size());
  for (Index i = 0; i < result.rows(); ++i)
    for (Index j = 0; j < result.cols(); ++j) result(i, j) = of.mass * of.center[i] * of.center[j];
  return result;
}

template <Scalar S>
S trace(const Matrix<S>& a) {
  S sum = 0;
  for (Index i = 0; i < a.rows(); ++i) sum += a(i, i);
  return sum;
}

/// By the squares of Cholesky's diagonal.
template <Scalar S>
bool is_positive_definite(Matrix<S> a) {
  for (Index j = 0; j < a.rows(); ++j) {
    if (!(a(j, j) > 0)) return false;
    for (Index i = j + 1; i < a.rows(); ++i) {
      const S factor = a(i, j) / a(j, j);
      for (Index l = j + 1; l < a.rows(); ++l) a(i, l) -= factor * a(j, l);
    }
  }
  return true;
}

/// \param moment about the point that is named, in space
/// \throws InputError if it is 0 across the body, or no more than rounding
template <Scalar S>
void refuse_flat(const Matrix<S>& moment, const std::string& about) {
  constexpr int few = 8;
  const S least = few * epsilon<S>() * max_norm(moment);
  if (is_positive_definite(Matrix<S>(moment - Matrix<S>::Identity(moment.rows(), moment.cols()) * least))) return;
  throw InputError("the body has no thickness across itself: about its " + about +
                   " one principal moment of inertia is the sum of the other two, as of a flat plate, and its mass "
                   "matrix is not positive definite; give it a little thickness by a moment that is a little less, as "
                   "inertia = [1, 2, 2.999] for [1, 2, 3], or by a small second moment across it");
}

}  // namespace

template <Scalar S>
Matrix<S> usable_second_moment(const MassDistribution<S>& of, bool fixed) {
  const Index d = of.center.size();
  const Matrix<S> center = of_the_center(of), about_center = of.second_moment - center;
  const std::string what =
      "no body has this 'second_moment', given or from its 'inertia', which is S, the integral of X X^T dm about the "
      "reference "
      "point: about the centre of mass c, ";
  // Another quantity typed here is off by much more than the digits that a sheet, which has 0 across itself, is given
  // with.
  const S rounding = (max_norm(of.second_moment) + trace(center)) / S(1'000'000);
  if (d == 2) {
    const S inertia = trace(about_center);
    if (!(inertia + rounding > 0) || (!fixed && !(inertia > 0)))
      throw InputError(what +
                       "the moment of inertia tr(S) - m |c|^2 is not positive; for a moment of inertia J about "
                       "c, take an S with the trace J + m |c|^2");
    if (is_positive_definite(fixed ? of.second_moment : about_center)) return of.second_moment;
    return fixed ? Matrix<S>(Matrix<S>::Identity(d, d) * S(trace(of.second_moment) / 2))
                 : Matrix<S>(center + Matrix<S>::Identity(d, d) * S(inertia / 2));
  }
  if (!is_positive_definite(Matrix<S>(about_center + Matrix<S>::Identity(d, d) * rounding)))
    throw InputError(what +
                     "S - m c c^T is not positive semidefinite; an inertia tensor J about c, of which no principal "
                     "moment is greater than the sum of the others, stands here as S = tr(J)/2 I - J + m c c^T");
  refuse_flat(fixed ? of.second_moment : about_center, fixed ? "fixed point" : "centre of mass");
  return of.second_moment;
}

std::vector<double> moments_of_inertia(const MassDistribution<double>& of) {
  const Matrix<double> about_center = of.second_moment - of_the_center(of);
  const double sum = trace(about_center);
  if (of.center.size() == 2) return {sum};
  const Eigen::SelfAdjointEigenSolver<Matrix<double>> eigen(about_center, Eigen::EigenvaluesOnly);
  std::vector<double> moments;
  for (const double along : eigen.eigenvalues()) moments.push_back(sum - along);
  std::sort(moments.begin(), moments.end());
  return moments;
}

#define HBVM_DEFINE(S) template Matrix<S> usable_second_moment<S>(const MassDistribution<S>&, bool);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

#include "hbvm/solver/continuation.hpp"

#include <algorithm>

#include "hbvm/basis/legendre.hpp"
#include "hbvm/linear/arrays.hpp"
#include "hbvm/linear/product.hpp"
#include "hbvm/scalar/binary_exponent.hpp"

namespace hbvm {

template <Scalar S>
Continuation<S>::Continuation(const Hbvm<S>& method, Index coordinates, Index multipliers)
    : s_(method.s),
      columns_(legendre_shift<S>(method.s).transpose()),
      P_(method.P_s, ParityMatrix<S>::Nodes::rows, ParityMatrix<S>::First::even),
      projection_(method.projection, ParityMatrix<S>::Nodes::columns, ParityMatrix<S>::First::even),
      coefficients_(s_, multipliers),
      x_(s_) {
  const Matrix<S> zero = Matrix<S>::Zero(s_, coordinates);
  last_ = {zero, zero, zero, Matrix<S>::Zero(s_, multipliers)};
  growth_ = binary_exponent(max_norm(columns_));
  for (Index i = 0; i < s_; ++i) part_.per_call.add_dots(coordinates + multipliers, s_ - i);
  if (multipliers > 0) part_.per_call += P_.operations(multipliers) + projection_.operations(multipliers);
}

template <Scalar S>
void Continuation<S>::keep(const StageUnknowns<S>& solution) {
  const PartCall counted(part_, timed_);
  set(last_.gamma, solution.gamma);
  set(last_.psi, solution.psi);
  set(last_.zeta, solution.zeta);
  set(last_.lambda, solution.lambda);
  known_ = true;
}

template <Scalar S>
long Continuation<S>::size_exponent(Index coordinate) const {
  long greatest = exponent_of_zero;
  for (Index i = 0; i < s_; ++i) greatest = std::max(greatest, binary_exponent(last_.gamma(i, coordinate)));
  return greatest;
}

template <Scalar S>
long Continuation<S>::error_exponent(Index coordinate) const {
  if (!known_) return -exponent_of_zero;
  // Every other coefficient of an even or odd motion is 0.
  long last = exponent_of_zero;
  for (Index i = std::max<Index>(s_ - 2, 0); i < s_; ++i)
    last = std::max(last, binary_exponent(last_.gamma(i, coordinate)));
  return last == exponent_of_zero ? last : last + growth_;
}

template <Scalar S>
void Continuation<S>::shift(Matrix<S>& x) {
  for (Index j = 0; j < x.cols(); ++j) {
    for (Index i = 0; i < s_; ++i) set_dot(x_[i], &columns_(i, i), 1, &x(i, j), 1, s_ - i);
    for (Index i = 0; i < s_; ++i) set(x(i, j), x_[i]);
  }
}

template <Scalar S>
void Continuation<S>::predict(StageUnknowns<S>& x) {
  const PartCall counted(part_, timed_);
  set(x.gamma, last_.gamma);
  set(x.psi, last_.psi);
  set(x.zeta, last_.zeta);
  shift(x.gamma);
  if (x.lambda.size() == 0) return;
  projection_.times(coefficients_, last_.lambda);
  shift(coefficients_);
  P_.times(x.lambda, coefficients_);
}

#define HBVM_DEFINE(S) template class Continuation<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm

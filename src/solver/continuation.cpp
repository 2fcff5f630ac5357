#include "solver/continuation.hpp"

#include <algorithm>
#include <utility>

#include "basis/legendre.hpp"
#include "linear/arrays.hpp"
#include "linear/product.hpp"
#include "scalar/binary_exponent.hpp"

namespace hbvm::core {

template <Scalar S>
Continuation<S>::Continuation(const Hbvm<S>& method, std::vector<Index> body, Index multipliers)
    : s_(method.s),
      degree_(method.s),
      body_(std::move(body)),
      rounding_(body_.empty() ? std::size_t{0} : static_cast<std::size_t>(body_.back() + 1)),
      columns_(legendre_shift<S>(method.s).transpose()),
      P_(method.P_s, ParityMatrix<S>::Nodes::rows, ParityMatrix<S>::First::even),
      projection_(method.projection, ParityMatrix<S>::Nodes::columns, ParityMatrix<S>::First::even),
      coefficients_known_(method.has_coefficients_of_lambda()),
      coefficients_(s_, multipliers),
      x_(s_) {
  const auto coordinates = static_cast<Index>(body_.size());
  const Matrix<S> zero = Matrix<S>::Zero(s_, coordinates);
  last_ = {zero, zero, zero, Matrix<S>::Zero(s_, multipliers)};
  growth_ = {0};
  for (Index l = 0; l < s_; ++l) {
    growth_.push_back(growth_.back());
    for (Index i = 0; i <= l; ++i) growth_.back() = std::max(growth_.back(), binary_exponent(columns_(l, i)));
  }
  for (Index i = 0; i < s_; ++i) part_.per_call.add_dots(coordinates + multipliers, s_ - i);
  if (multipliers > 0 && !coefficients_known_)
    part_.per_call += P_.operations(multipliers) + projection_.operations(multipliers);
}

template <Scalar S>
void Continuation<S>::keep(const StageUnknowns<S>& solution) {
  const PartCall counted(part_);
  set(last_, solution);
  known_ = true;
  find_degree();
}

template <Scalar S>
void Continuation<S>::find_degree() {
  // Of sums and products of a step.
  constexpr long rounding_bits = 4;
  std::ranges::fill(rounding_, exponent_of_zero);
  for (std::size_t j = 0; j < body_.size(); ++j) {
    long& greatest = rounding_[static_cast<std::size_t>(body_[j])];
    greatest = std::max(greatest, size_exponent(static_cast<Index>(j)));
  }
  for (long& exponent : rounding_)
    if (exponent != exponent_of_zero) exponent += rounding_bits - significand_bits<S>();
  const auto counts = [&](Index i) {
    for (std::size_t j = 0; j < body_.size(); ++j)
      if (binary_exponent(last_.gamma(i, static_cast<Index>(j))) > rounding_[static_cast<std::size_t>(body_[j])])
        return true;
    return false;
  };
  degree_ = s_;
  while (degree_ > 1 && !counts(degree_ - 1)) --degree_;
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
  long last = rounding_[static_cast<std::size_t>(body_[static_cast<std::size_t>(coordinate)])];
  if (last == exponent_of_zero) return last;
  // Every other coefficient of an even or odd motion is 0.
  for (Index i = std::max<Index>(degree_ - 2, 0); i < degree_; ++i)
    last = std::max(last, binary_exponent(last_.gamma(i, coordinate)));
  return last + growth_[static_cast<std::size_t>(degree_)];
}

template <Scalar S>
void Continuation<S>::shift(Matrix<S>& x) {
  for (Index j = 0; j < x.cols(); ++j) {
    for (Index i = 0; i < degree_; ++i) set_dot(x_[i], &columns_(i, i), 1, &x(i, j), 1, degree_ - i);
    for (Index i = 0; i < degree_; ++i) set(x(i, j), x_[i]);
    for (Index i = degree_; i < s_; ++i) set_zero(x(i, j));
  }
}

template <Scalar S>
void Continuation<S>::predict(StageUnknowns<S>& x) {
  const PartCall counted(part_);
  set(x.gamma, last_.gamma);
  set(x.psi, last_.psi);
  set(x.zeta, last_.zeta);
  shift(x.gamma);
  if (x.lambda.size() == 0) return;
  if (coefficients_known_) {
    set(x.lambda, last_.lambda);
    shift(x.lambda);
    return;
  }
  projection_.times(coefficients_, last_.lambda);
  shift(coefficients_);
  P_.times(x.lambda, coefficients_);
}

#define HBVM_DEFINE(S) template class Continuation<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

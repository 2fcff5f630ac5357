#pragma once

#include "linear/parity_matrix.hpp"
#include "method/hbvm.hpp"
#include "scalar/archive.hpp"
#include "solver/part_count.hpp"
#include "solver/stage_equations.hpp"

namespace hbvm::core {

/// Start values from the polynomials of the step before, followed beyond its end (Hairer and Wanner, Solving Ordinary
/// Differential Equations II, 1996, section IV.8). With T of P_j(1 + c) = sum_i P_i(c) T_ij, coefficients gamma become
/// T gamma. Multipliers become the same as a polynomial through their nodes. All steps have one size.
///
/// Legendre polynomials grow by 3 + 2 sqrt 2 a degree out to 2, and the coefficients of a step of high order fall by
/// more. With the 22 stages for 50 digits of the satellites they fall by 14, and 8 digits are right before the first
/// sweep. Coefficients that are rounding beside the greatest of their body would grow, too. From the degree on from
/// which all are rounding, they are left out.
template <Scalar S>
class Continuation {
 public:
  /// \param body the number of the body, or other block of the mass matrix, of each coordinate, ascending from 0
  Continuation(const Hbvm<S>& method, std::vector<Index> body, Index multipliers);

  void clear() { known_ = false; }
  /// The solution of a step.
  void keep(const StageUnknowns<S>& solution);
  /// log2 of the greatest coefficient of a momentum, and of the error that its prediction may have. The error is judged
  /// by the last coefficients that are not rounding, or by rounding, and by their growth. It is the greatest number if
  /// no step is known.
  long size_exponent(Index coordinate) const;
  long error_exponent(Index coordinate) const;
  /// gamma and lambda of the next step; psi and zeta of the last one, for their size.
  void predict(StageUnknowns<S>& x);

  const PartCount& part_count() const { return part_; }
  void remember(Archive& archive) {
    archive(known_, last_.gamma, last_.psi, last_.zeta, last_.lambda);
    if (known_) find_degree();
  }

 private:
  /// x = T x, column by column.
  void shift(Matrix<S>& x);
  /// Sets degree_ and rounding_.
  void find_degree();

  Index s_, degree_;  ///< coefficients below this degree count
  std::vector<Index> body_;
  std::vector<long> rounding_;  ///< of each body, as log2
  Matrix<S> columns_;           ///< column i holds T_il, l = i .. s - 1, from row i on
  std::vector<long> growth_;    ///< log2 of the greatest entry in the first columns of T, by their number
  ParityMatrix<S> P_, projection_;
  StageUnknowns<S> last_;
  bool coefficients_known_;  ///< of lambda: they are its unknowns
  Matrix<S> coefficients_;   ///< s x nu
  Vector<S> x_;
  bool known_ = false;
  PartCount part_{"continuation of the last step"};
};

}  // namespace hbvm::core

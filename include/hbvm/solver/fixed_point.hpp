#pragma once

#include "hbvm/solver/extrapolation.hpp"
#include "hbvm/solver/stage_solver.hpp"

namespace hbvm {

/// The fixed-point iteration (iter) for the stage equations (dispro1).
///
/// In the paper's order a sweep computes all new values from old ones, and the first starts from gamma = psi = 0.
/// Otherwise a sweep uses each value as soon as it is known (psi from gamma, then lambda and zeta, then gamma), and
/// starts from the extrapolation of the last steps' gamma; if that leads nowhere, once more from the constant v = p0.
///
/// It stops when the increment times the factor by which it fell, which is what the next sweep would change (in the
/// paper's order, where increments fall unevenly: the increment itself), is below epsilon/4 of the scale: the largest
/// of |p0|, |gamma|, h |psi| and h |zeta|. The increment is the max-norm of that of gamma, and in the paper's order,
/// where psi lags, of h psi.
///
/// It also stops when the increment is below C epsilon, for a scale that includes |M q0|/h (positions are rounded, too,
/// and h M^-1 gamma is added to them), and has not fallen below its least value for two sweeps in a row: then it is
/// round-off. C = 4 (k + 3 s + m + s nu) is an upper bound of the lengths of the sums of one sweep, where a sum of n
/// terms carries n roundings, and 4 for what they are passed through.
///
/// It fails if an increment is not finite, if (lam) is singular, and if the increments, above C epsilon, do not fall
/// below their least value for `patience` sweeps: they stagnate or grow.
template <Scalar S>
class FixedPoint final : public StageSolver<S> {
 public:
  enum class Order { paper, newest };
  static constexpr long patience = 40;

  FixedPoint(const Problem<S>& problem, const Hbvm<S>& method, const S& step, Order order);

  long solve(const Vector<S>& q0, const Vector<S>& p0) override;
  const StageUnknowns<S>& unknowns() const override { return x_; }
  const Vector<S>& position_change() const override { return position_change_; }
  const Vector<S>& momentum_change() const override { return momentum_change_; }
  SolverCounts counts() const override { return {equations_.effect_counts(), equations_.part_counts()}; }
  void measure_time() override { equations_.measure_time(); }

 private:
  enum class Start { zero, constant };
  void prepare(Start start, const Vector<S>& p0);
  long iterate();
  [[nodiscard]] bool sweep();
  void measure_increment();
  void measure_size();

  StageEquations<S> equations_;
  Order order_;
  StageUnknowns<S> x_;
  Matrix<S> gamma_before_, psi_before_;
  Extrapolation<S> extrapolation_;  ///< of gamma
  Vector<S> position_change_, momentum_change_;
  S position_scale_ = 0, tolerance_ = 0, quarter_epsilon_ = 0, sixteen_ = 16;
  // Kept from sweep to sweep: creating them allocates.
  S increment_ = 0, scaled_ = 0, size_ = 0, left_ = 0, last_ = 0, least_ = 0, term_ = 0;
};

#define HBVM_DECLARE(S) extern template class FixedPoint<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DECLARE)
#undef HBVM_DECLARE

}  // namespace hbvm

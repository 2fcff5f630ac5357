#pragma once

#include <memory>

#include "solver/fixed_point.hpp"

namespace hbvm::core {

/// Chooses between two solvers, step by step. It begins with the preferred one, and takes the other from the step on in
/// which that fails or needs more than `slow` sweeps. If the other fails, it goes back.
template <Scalar S>
class Automatic final : public StageSolver<S> {
 public:
  static constexpr long slow = FixedPoint<S>::slow;

  /// In double the fixed point is preferred, whose sweeps are cheaper. In more digits Newton is, from where the fixed
  /// point comes to in double.
  Automatic(const Problem<S>& problem, const Hbvm<S>& method);

  long solve(const StepStart<S>& start) override;
  const StageUnknowns<S>& unknowns() const override { return current().unknowns(); }
  const StepChange<S>& change() const override { return current().change(); }
  SolverCounts counts() const override;
  void remember(Archive& archive) override;

 private:
  const StageSolver<S>& current() const { return *solvers_[static_cast<std::size_t>(used_)]; }
  StageSolver<S>& make(int which);

  const Problem<S>& problem_;
  const Hbvm<S>& method_;
  std::unique_ptr<StageSolver<S>> solvers_[2];
  int used_ = 0;  ///< 0: fixed point, 1: Newton
  long last_sweeps_ = 0;
};

}  // namespace hbvm::core

#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "step/stepper.hpp"

namespace hbvm::core {

/// What was done to steps that failed.
struct HalvingLog {
  long steps = 0;       ///< of the grid, that were made of smaller ones
  long substeps = 0;    ///< what those were made of
  int depth = 0;        ///< the smallest was 2^-depth of a step
  long first_step = 0;  ///< steps of the grid made before the first of them

  void remember(Archive& archive) { archive(steps, substeps, depth, first_step); }
};

/// Steps that are divided where they fail: a step of size h is made as two of h/2, and so on down to 2^-20 h. The mesh
/// stays that of the grid. The next (sub)step is tried at the size that succeeded last. After a success it is tried at
/// twice that size, where the grid allows. After attempts in vain this is done only after 2, 4, … 1024 successes.
///
/// Energy and constraints are conserved by each substep. But a sequence of sizes that depends on failures is not
/// symmetric: where the motion is reversed, other steps may be divided.
template <Scalar S>
class HalvingStepper final : public Stepper<S> {
 public:
  static constexpr int deepest = 20;
  static constexpr long longest_patience = 1'024;
  /// Makes what makes parts of 2^-depth of a step, each of which learns from its own last ones.
  using Make = std::function<std::unique_ptr<Stepper<S>>(int depth)>;

  explicit HalvingStepper(Make make);

  const Problem<S>& problem() const override { return steppers_.front()->problem(); }
  /// \throws StageFailure of the whole step, if substeps of 2^-20 fail, too
  StepResult<S> step(State<S>& state, const S& h) override;
  SolverCounts counts() const override;
  void remember(Archive& archive) override;

  const HalvingLog& log() const { return log_; }

 private:
  Stepper<S>& stepper(int depth);

  Make make_;
  std::vector<std::unique_ptr<Stepper<S>>> steppers_;  ///< by depth
  std::vector<S> parts_;                               ///< of the last step: 2^-depth h
  State<S> before_;
  HalvingLog log_;
  // What it remembers from step to step.
  long made_ = 0;                      ///< steps of the grid
  int depth_ = 0, last_ = 0;           ///< to be tried next; the one that succeeded last
  long successes_ = 0, patience_ = 1;  ///< successes since the last failure or change of size, and those to wait for
};

}  // namespace hbvm::core

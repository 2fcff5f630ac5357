#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "integrate/observations.hpp"
#include "problem/redundant_constraints.hpp"
#include "problem/state_evaluator.hpp"

namespace hbvm::core {

/// Writes every `every`-th mesh point and the last as a line of comma-separated decimals that read back exactly. These
/// are t, q, p, (57), the output state's p and multiplier, H - H_0, and the max-norms of g and of the hidden
/// constraint. Multipliers are those of all constraints, redundant ones included. Then come the observations. The first
/// line has the names of the columns.
template <Scalar S>
class Trajectory final : public Observer<S> {
 public:
  /// \param columns the names, of trajectory_columns()
  /// \param observations that see each point before; null if there are none
  Trajectory(const Problem<S>& problem, std::ostream& out, long every, long steps,
             const std::vector<std::string>& columns, const Observations<S>* observations = nullptr);
  void observe(const Snapshot<S>& snapshot) override;
  /// What `out` holds is its owner's to remember.
  void remember(Archive& archive) override { archive(H0_); }

 private:
  const Problem<S>& problem_;
  StateEvaluator<S> point_;
  RedundantConstraints<S> redundant_;
  std::ostream& out_;
  long every_, steps_;
  std::vector<std::string> columns_;
  const Observations<S>* observations_;
  S H0_;
};

}  // namespace hbvm::core

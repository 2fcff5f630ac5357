#pragma once

#include "scalar/archive.hpp"
#include "solver/continuation.hpp"
#include "solver/extrapolation.hpp"
#include "solver/stage_equations.hpp"

namespace hbvm::core {

/// What Newton's iteration starts from. It is the extrapolation of the last steps' solutions, or the continued
/// polynomials of the last one, which are nearer at many stages. In the first step, and where that leads nowhere, it is
/// the constant v = p0.
template <Scalar S>
class NewtonStarts {
 public:
  NewtonStarts(const Problem<S>& problem, const Hbvm<S>& method, const StageUnknowns<S>& like);

  /// Forgets all solutions: the next step is of another size.
  void clear();
  /// Whether there are solutions to predict the next one from.
  bool known() const { return !extrapolation_.empty(); }
  /// Sets gamma and lambda by the steps before.
  void predict(StageUnknowns<S>& x);
  /// Sets gamma to the constant v = p0 of the step that the equations were started with, and lambda to the multipliers
  /// there.
  static void set_constant(StageEquations<S>& equations, StageUnknowns<S>& x);
  /// Keeps the solution of a step.
  void keep(const StageUnknowns<S>& solution);

  std::vector<PartCount> part_counts() const { return {count_, continuation_.part_count()}; }
  void remember(Archive& archive) { archive(extrapolation_, continuation_); }

 private:
  /// Whether the continued polynomials promise a smaller error than the extrapolation.
  bool continuation_is_nearer() const;

  const Problem<S>& problem_;
  Extrapolation<S> extrapolation_;
  Continuation<S> continuation_;
  Vector<S> sequence_;  ///< gamma and lambda, column by column
  PartCount count_{"extrapolation"};
};

}  // namespace hbvm::core

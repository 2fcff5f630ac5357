#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "hbvm/scalar/archive.hpp"
#include "hbvm/solver/stage_equations.hpp"
#include "hbvm/solver/stage_failure.hpp"

namespace hbvm {

/// By effect and by part of the stage equations, in whatever precision they were evaluated.
struct SolverCounts {
  std::vector<EffectCount> effects;
  std::vector<PartCount> parts;

  void remember(Archive& archive) {
    archive.sized(effects);
    archive.sized(parts);
  }
};

/// sum += other; a constant force counts once, whatever the number of solvers.
template <Scalar S>
void add_counts(SolverCounts& sum, const SolverCounts& other, const Problem<S>& problem) {
  if (sum.parts.empty()) {
    sum = other;
    return;
  }
  for (std::size_t t = 0; t < sum.effects.size(); ++t) {
    if (problem.potential.terms[t].constant_force) continue;
    sum.effects[t].calls += other.effects[t].calls;
    sum.effects[t].evaluations += other.effects[t].evaluations;
    sum.effects[t].seconds += other.effects[t].seconds;
  }
  for (std::size_t i = 0; i < other.parts.size(); ++i) {
    if (i == sum.parts.size()) {
      sum.parts.push_back(other.parts[i]);
      continue;
    }
    sum.parts[i].calls += other.parts[i].calls;
    sum.parts[i].seconds += other.parts[i].seconds;
  }
}

/// The same as a new value.
template <Scalar S>
SolverCounts sum_of(SolverCounts counts, const SolverCounts& other, const Problem<S>& problem) {
  add_counts(counts, other, problem);
  return counts;
}

/// Solves the stage equations of one step after the other. What it learns from one step serves the next, unless that
/// is of another size.
template <Scalar S>
class StageSolver {
 public:
  virtual ~StageSolver() = default;

  /// \return the number of sweeps over the stage equations
  /// \throws StageFailure
  virtual long solve(const StepStart<S>& start) = 0;

  /// The solution: its gamma and lambda are converged; its psi and zeta are those of the last sweep.
  virtual const StageUnknowns<S>& unknowns() const = 0;
  virtual const StepChange<S>& change() const = 0;

  /// What was done since construction.
  virtual SolverCounts counts() const = 0;
  /// Also measure the time that effects and parts of the equations take.
  virtual void measure_time() = 0;

  /// All that the next steps depend on to the last bit, beside problem, method, step and state; not the counts.
  virtual void remember(Archive& archive) = 0;
};

/// The solvers by the name a user gives them.
enum class SolverKind {
  automatic,    ///< in double the fixed point, in more digits Newton, and the other where that fails or is slow
  newton,       ///< mixed-precision Newton
  fixed_point,  ///< newest values at once, started from the previous step's polynomial
  paper         ///< (iter) to the letter, started from 0
};
/// \throws InputError for an unknown name
SolverKind parse_solver(std::string_view name);
std::string_view name_of(SolverKind kind);

template <Scalar S>
std::unique_ptr<StageSolver<S>> make_solver(SolverKind kind, const Problem<S>& problem, const Hbvm<S>& method);

}  // namespace hbvm

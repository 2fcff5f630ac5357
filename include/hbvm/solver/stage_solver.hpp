#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "hbvm/error.hpp"
#include "hbvm/solver/stage_equations.hpp"

namespace hbvm {

/// No solution of the stage equations was reached. `increment` is the last one, scaled as FixedPoint says.
class StageFailure : public Error {
 public:
  StageFailure(const std::string& what, std::string increment, long sweeps)
      : Error(what), increment_(std::move(increment)), sweeps_(sweeps) {}
  const std::string& increment() const { return increment_; }
  long sweeps() const { return sweeps_; }

 private:
  std::string increment_;
  long sweeps_;
};

/// Solves the stage equations of one step after the other.
template <Scalar S>
class StageSolver {
 public:
  virtual ~StageSolver() = default;

  /// Solves for the step that starts at (q0, p0).
  /// \return the number of sweeps over the stage equations
  /// \throws StageFailure
  virtual long solve(const Vector<S>& q0, const Vector<S>& p0) = 0;

  /// The solution, and the equations at it.
  virtual const StageUnknowns<S>& unknowns() const = 0;
  virtual const StageEquations<S>& equations() const = 0;
  /// Also measure the time that effects and parts of the equations take.
  virtual void measure_time() = 0;
};

/// The solvers by the name a user gives them.
enum class SolverKind {
  fixed_point,  ///< newest values at once, started from the previous step's polynomial
  paper         ///< (iter) to the letter, started from 0
};
/// \throws InputError for an unknown name
SolverKind parse_solver(std::string_view name);
std::string_view name_of(SolverKind kind);

template <Scalar S>
std::unique_ptr<StageSolver<S>> make_solver(SolverKind kind, const Problem<S>& problem, const Hbvm<S>& method,
                                            const S& step);

}  // namespace hbvm

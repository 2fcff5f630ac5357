#include "solver/automatic.hpp"

#include "solver/newton.hpp"

namespace hbvm::core {

template <Scalar S>
Automatic<S>::Automatic(const Problem<S>& problem, const Hbvm<S>& method)
    : problem_(problem), method_(method), used_(std::same_as<S, double> ? 0 : 1) {
  make(used_);
}

template <Scalar S>
StageSolver<S>& Automatic<S>::make(int which) {
  std::unique_ptr<StageSolver<S>>& solver = solvers_[static_cast<std::size_t>(which)];
  if (!solver && which == 0) solver = make_solver(SolverKind::fixed_point, problem_, method_);
  if (!solver) solver = std::make_unique<Newton<S>>(problem_, method_, Newton<S>::Start::fixed_point);
  return *solver;
}

template <Scalar S>
long Automatic<S>::solve(const StepStart<S>& start) {
  long sweeps = 0;
  if (used_ == 0 && last_sweeps_ > slow) used_ = 1;
  last_sweeps_ = 0;
  try {
    sweeps = make(used_).solve(start);
  } catch (const StageFailure& failure) {
    const int other = 1 - used_;
    try {
      sweeps = failure.sweeps() + make(other).solve(start);
    } catch (const StageFailure& second) {
      throw StageFailure(failure.cause(),
                         failure.what() + std::string(" (fixed point and Newton: ") + second.what() + ")",
                         second.increment(), failure.sweeps() + second.sweeps());
    }
    used_ = other;
    return sweeps;
  }
  last_sweeps_ = sweeps;
  return sweeps;
}

template <Scalar S>
SolverCounts Automatic<S>::counts() const {
  SolverCounts sum;
  for (const auto& solver : solvers_)
    if (solver) add_counts(sum, solver->counts(), problem_);
  return sum;
}

template <Scalar S>
void Automatic<S>::remember(Archive& archive) {
  archive(used_, last_sweeps_);
  for (const int which : {0, 1}) {
    bool made = solvers_[static_cast<std::size_t>(which)] != nullptr;
    archive(made);
    if (made) make(which).remember(archive);
  }
}

#define HBVM_DEFINE(S) template class Automatic<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

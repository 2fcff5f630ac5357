#pragma once

#include <memory>

#include "problem/in_double.hpp"
#include "solver/simplified_newton.hpp"

namespace hbvm::core {

/// Whether a solution of the stage equations is the one that shrinks to the start with the step. There may be others,
/// and an iteration that does not contract well may find them. Follows that one from much shorter steps by Newton's
/// iteration in double, and allocates what it needs when it is first asked. Problem and method must outlive it.
template <Scalar S>
class RootCheck {
 public:
  RootCheck(const Problem<S>& problem, const Hbvm<S>& method) : problem_(problem), method_(method) {}

  enum class Verdict {
    same,
    other,
    lost,    ///< the solution cannot be followed
    unknown  ///< double does not hold the problem
  };
  Verdict judge(const StepStart<S>& start, const Matrix<S>& gamma);
  /// Residuals of the last judgement.
  long sweeps() const { return sweeps_; }

 private:
  struct Rounded {
    Problem<double> problem;
    Hbvm<double> method;
    SimplifiedNewton<double> newton;
    Rounded(const Problem<S>& problem, const Hbvm<S>& method);
  };

  const Problem<S>& problem_;
  const Hbvm<S>& method_;
  std::unique_ptr<Rounded> rounded_;
  long sweeps_ = 0;
};

}  // namespace hbvm::core

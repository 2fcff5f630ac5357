#pragma once

#include "solver/stage_equations.hpp"

namespace hbvm::core {

/// How far psi_hat of k nodes is from that of k + s, along the polynomial of a step that was made. It says whether more
/// nodes would change the step. It goes body by body, so that what a light one feels counts beside a heavy one.
template <Scalar S>
class QuadratureDefect {
 public:
  QuadratureDefect(const Problem<S>& problem, int k, int s);
  QuadratureDefect(const QuadratureDefect&) = delete;

  /// The greatest change of a body's psi_hat, over 16 (k + s) epsilon of the size of its psi_hat or zeta. Round-off
  /// makes it at most 1. psi_0 is the mean force, and the sums of k products behind it carry k roundings each. The
  /// positions' round-off relative to the step's displacement comes on top.
  /// \param x the solution of the step that starts there
  const S& measure(const StepStart<S>& start, const StageUnknowns<S>& x);

  const S& defect() const { return defect_; }
  /// The same change over the size alone. One that is more than sqrt(epsilon) is no round-off, however ill-conditioned
  /// the force.
  const S& relative() const { return relative_; }
  /// Whether it is no more than what rounding usually makes of a mean of k + s terms: 4 sqrt(k + s) epsilon.
  bool is_least() const { return relative_ <= least_; }
  bool may_be_round_off() const { return relative_ * relative_ < epsilon<S>(); }

 private:
  /// A method with its equations, which refer to it.
  struct Nodes {
    Hbvm<S> method;
    StageEquations<S> equations;
    Matrix<S> psi;
    Nodes(const Problem<S>& problem, int k, int s);
  };

  const Problem<S>& problem_;
  Nodes few_, more_;
  S unit_, least_, defect_ = 0, relative_ = 0, difference_ = 0, size_ = 0, t_ = 0;
};

}  // namespace hbvm::core

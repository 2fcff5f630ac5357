#pragma once

#include "solver/continuation.hpp"
#include "solver/extrapolation.hpp"
#include "solver/jacobian.hpp"
#include "solver/position_scale.hpp"
#include "solver/solver_counts.hpp"
#include "solver/stage_solver.hpp"
#include "solver/stopping_rule.hpp"

namespace hbvm::core {

/// Simplified Newton iteration for the stage equations with everything in the working precision. In double it is
/// Newton's solver itself, and the start and the Jacobian of the mixed-precision one; in more digits it serves where
/// double cannot hold the problem or its condition.
///
/// A Jacobian is kept, also from step to step, while the increments fall by `slow` or more a sweep. If it costs as much
/// as 16 sweeps and more (for 24 stages it may be sixty, for 3 seven; 8 if the solution is a start for more digits,
/// which correct it anyway), it is kept while they fall so fast that those left cost less than a new one. Then between
/// two evaluations each correction adds what it shows of the Jacobian by an update of rank one (Broyden's good one, in
/// the form of corrections: Kelley, Iterative Methods for Linear and Nonlinear Equations, 1995, section 7.3). Where
/// increments grow although the Jacobian is that of the last iterate, the iterate was a step too far: it is taken back
/// and made by half (Deuflhard's natural monotonicity).
///
/// The iteration starts from the extrapolation of the last steps' solutions, or from the polynomials of the last one,
/// which are nearer at many stages, or if that leads nowhere (and in the first
/// step) from the constant v = p0, or from the solution of a step half as long. The stage equations may have several
/// solutions, of which the one that shrinks to the start with the step is meant: a solution far from its start is
/// followed from shorter steps as well, and the one found so is taken if they differ.
///
/// StoppingRule says when it ends. Above what it takes for rounding the increments may be rounding, too, magnified by
/// an ill-conditioned problem: if they do not fall with the Jacobian of the iterate itself, they are.
template <Scalar S>
class SimplifiedNewton {
 public:
  /// As a start for more digits a solution is good when increments have come down to what may be rounding, body by
  /// body; what StoppingRule waits for beyond is that errors of many steps do not add up.
  enum class Wanted { solution, start };
  SimplifiedNewton(const Problem<S>& problem, const Hbvm<S>& method, Wanted wanted = Wanted::solution);

  /// \return the number of residuals
  /// \throws StageFailure
  long solve(const StepStart<S>& from);
  /// The solution that shorter and shorter steps lead to, found by following it from 2^-12 or 2^-30 of the step.
  /// \return the number of residuals
  /// \throws StageFailure
  long follow(const StepStart<S>& from);
  /// What was done: by effect and by part of the equations, of the Jacobian and of the iteration.
  SolverCounts counts() const;
  /// The same in a step of more digits, the stage equations as one part.
  std::vector<PartCount> counts_in_double() const;
  /// Also measure the time that takes.
  void measure_time();
  /// The same without the parts of the stage equations.
  void measure_time_in_double();

  /// Evaluates the Jacobian at the solution, with positions, velocities and gradients rounded from those of more
  /// digits. \return false if it is singular
  template <Scalar T>
  [[nodiscard]] bool refresh(const StageEquations<T>& at) {
    equations_.round(at);
    usable_ = jacobian_.factor(equations_, x_.lambda);
    return usable_;
  }

  const StageUnknowns<S>& unknowns() const { return x_; }
  Jacobian<S>& jacobian() { return jacobian_; }
  const Jacobian<S>& jacobian() const { return jacobian_; }
  StageEquations<S>& equations() { return equations_; }
  const StageEquations<S>& equations() const { return equations_; }
  const StepChange<S>& change() const { return step_change_; }
  /// The change of h (psi_0 - zeta_0) when gamma changes by -correction, where the residual was `momentum`: row 0 of
  /// X_s^-1 (momentum - correction), since gamma - e_1 p0 = h X_s (psi - zeta).
  void add_change_of_momentum(const Matrix<S>& momentum, const Matrix<S>& correction, Vector<S>& change) const;

  void remember(Archive& archive) {
    archive(h_, extrapolation_, continuation_, usable_);
    if (usable_) archive(jacobian_);
  }

 private:
  enum class Start { previous, constant, shorter, shortest };
  void prepare(Start start, const Vector<S>& p0);
  /// Than the extrapolation, by what either expects of its error.
  bool continuation_is_nearer() const;
  /// Follows the solution from a step 2^-halvings as long, where the constant v = p0 is a good start if it ever is, to
  /// the full one, by steps that grow as fast as Newton's iteration can follow.
  long grow(const StepStart<S>& from, int halvings);
  /// The equations of the step from there, h long.
  void begin(const StepStart<S>& from, const S& h);
  /// From the start, for the step that the equations were started with.
  long iterate();
  /// x_ = base_ - factor correction_.
  void move_from_base(const S& h, const S& factor);
  /// Takes the correction by the Jacobian to that by the updated one.
  void update_correction();
  /// Remembers the correction that is made, or forgets all if it is `small`: of rounding nothing is to be learnt.
  void keep_correction(bool small);
  /// The product of the momenta of two corrections, each coordinate in units of base_scale_.
  S product(const StageResidual<S>& a, const StageResidual<S>& b);
  /// base_scale_ = the scales of x_, each the greatest of its body.
  void keep_base_scale();
  /// change_ = the greatest correction over base_scale_.
  void measure_change();
  /// Whether the sweeps that a new Jacobian saves cost more than it does, if increments go on to fall as they did.
  /// \param fresh whether the last one is that of the last iterate
  bool evaluation_pays(bool fresh) const;
  /// A residual as large as what it is the residual of shows no solution, however small the increments.
  bool residual_is_small();
  /// start_size_ = the greatest of |p0|, h |psi| and h |zeta| at start_, each coordinate with its body's.
  void keep_start_size();
  /// Whether the momenta of some body are farther from those of start_ than the forces there explain, or its forces psi
  /// have changed by more than half of their size.
  bool is_far_from_start() const;
  /// Whether what a single constraint does to some body has changed by much more than its momentum and forces: where
  /// constraints are nearly dependent, branches lie side by side, and only multipliers tell that one was left.
  bool multipliers_run_wild() const;

  const Problem<S>& problem_;
  const Hbvm<S>& method_;
  Wanted wanted_;
  StageEquations<S> equations_;
  Jacobian<S> jacobian_;
  bool usable_ = false;  ///< the Jacobian
  StageUnknowns<S> x_;
  StageResidual<S> residual_;
  Matrix<S> momentum_;      ///< residual before it is solved for
  StageUnknowns<S> start_;  ///< gamma and lambda of the iteration's start, psi and zeta there
  std::vector<StageResidual<S>>
      kept_;  ///< corrections since the Jacobian, if it is expensive, was evaluated or the iteration began
  std::vector<S> squares_;              ///< of their size
  std::size_t known_ = 0;               ///< of them
  StageResidual<S> base_, correction_;  ///< an iterate (gamma, h lambda) and the step from it
  Vector<S> base_scale_;                ///< of its coordinates
  Vector<S> start_size_;
  Vector<S> first_row_of_inverse_X_, sequence_;
  StepChange<S> step_change_;
  Extrapolation<S> extrapolation_;
  Continuation<S> continuation_;
  PositionScale<S> position_scale_;
  Vector<S> positions_;
  StoppingRule<S> rule_;
  PartCount equations_count_{"stage equations"};
  PartCount start_count_{"extrapolation"}, increment_count_{"increments and stopping rule"};
  bool timed_ = false;
  long max_sweeps_;
  int falls_ = 0;                ///< of the increments, from first_ on, with one Jacobian
  int rises_ = 0;                ///< in a row
  double sweeps_an_evaluation_;  ///< that cost as much as a Jacobian
  S tolerance_, root_epsilon_, coarse_;
  S h_ = 0;  ///< of the last step
  S change_ = 0, last_ = 0, first_ = 0, t_ = 0, u_ = 0, solved_ = 0;
};

#define HBVM_DECLARE(S) extern template class SimplifiedNewton<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DECLARE)
#undef HBVM_DECLARE

}  // namespace hbvm::core

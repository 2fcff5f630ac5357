#pragma once

#include <memory>
#include <optional>

#include "problem/in_double.hpp"
#include "solver/fixed_point.hpp"
#include "solver/simplified_newton.hpp"

namespace hbvm::core {

/// Newton's iteration in mixed precision: the residual in the working precision, the Jacobian and its factors in
/// double.
///
/// The stage equations are first solved in double, by Newton's iteration or by the fixed point. The sweeps of that are
/// cheaper, as long as they are few. With more digits, the first residual at that solution has all displacements to
/// the last bit of a double. (Of bodies far from the origin, double itself leaves few.) From these the Jacobian is
/// evaluated and factored. With it each sweep wins about 15 digits, and its residual needs only the digits that the
/// correction can use. In Mpfr it is evaluated with problem, method and state rounded to a few more digits than are to
/// be won.
///
/// The last residual is one of the working precision, and StoppingRule says when it is reached.
///
/// Everything is done in the working precision where double fails. It may not hold the problem (masses beyond its
/// range), nor solve the equations. Or it wins less than `least_bits` a sweep: the condition of the constraints is
/// beyond 10^12.
template <Scalar S>
class Newton final : public StageSolver<S> {
 public:
  /// What a sweep with the Jacobian in double has to win.
  static constexpr long least_bits = 10;

  /// What solves the equations in double first, where there are more digits.
  enum class Start { newton, fixed_point };

  Newton(const Problem<S>& problem, const Hbvm<S>& method, Start start = Start::newton);

  long solve(const StepStart<S>& start) override;
  const StageUnknowns<S>& unknowns() const override { return x_; }
  const StepChange<S>& change() const override { return change_; }
  SolverCounts counts() const override;
  void remember(Archive& archive) override;

 private:
  /// The stage equations in fewer digits.
  struct Level {
    Problem<S> problem;
    Hbvm<S> method;
    StageEquations<S> equations;
    StageUnknowns<S> x;
    StageResidual<S> r;
    Vector<S> q0, p0;
    S h = 0;
    /// To be made within the scope of its digits.
    Level(const Problem<S>& full_problem, const Hbvm<S>& full_method);
  };
  struct Rung {
    unsigned digits;
    int bits;
    std::unique_ptr<Level> level;
  };

  /// Takes rounded_ to the solution of the step from rounded_q0_ and rounded_p0_. \return the number of sweeps
  long start_in_double();
  /// \return the number of residuals, and whether the corrections fell
  std::pair<long, bool> refine(const StepStart<S>& from);
  long solve_in_full(const StepStart<S>& start);
  /// The residual of x_, and the equations that it was evaluated by: with at least so many bits if there are as many.
  struct Evaluated {
    const StageEquations<S>& equations;
    const StageResidual<S>& residual;
  };
  Evaluated evaluate(long bits);
  /// Into correction_, scaled by 2^-exponent.
  void take_residual(const StageResidual<S>& r, long& exponent);
  void make_rungs();
  void take_step(const S& h);

  const Problem<S>& problem_;
  const Hbvm<S>& method_;
  S h_ = 0;  ///< of the last step
  long bits_ = significand_bits<S>();
  std::optional<Problem<double>> rounded_problem_;
  std::optional<Hbvm<double>> rounded_method_;
  std::optional<SimplifiedNewton<double>> rounded_;
  std::optional<FixedPoint<double>> swept_;    ///< if the fixed point is to start
  bool sweeps_ = true;                         ///< whether swept_ solves the steps of this size in few sweeps
  std::unique_ptr<SimplifiedNewton<S>> full_;  ///< once double has failed
  Vector<double> rounded_q0_, rounded_p0_;
  std::optional<StageEquations<S>> equations_;  ///< in double those of rounded_ serve
  StageUnknowns<S> x_;
  StageResidual<S> r_;
  std::vector<Rung> rungs_;
  StageResidual<double> correction_;
  Matrix<double> momentum_;
  std::optional<MomentumChange<double>> momentum_change_;
  Vector<double> last_change_;  ///< of the momentum
  StepChange<S> change_;
  PositionScale<S> position_scale_;
  Vector<S> positions_;
  StoppingRule<S> rule_;
  PartCount rounding_count_{"rounding of the residual to double"}, update_count_{"increments and stopping rule"};
  bool failed_in_double_ = false;
  S rate_ = 1, t_ = 0;  ///< rate_: at which corrections fell in the last step
};

}  // namespace hbvm::core

#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hbvm/error.hpp"
#include "reference/proof/step_bounds.hpp"
#include "reference/taylor_step.hpp"

namespace hbvm::core {

/// Bounds became so wide that they hold no longer; with more digits they may.
class BoundsTooWide : public IntegrationError {
 public:
  using IntegrationError::IntegrationError;
};

/// A motion between bounds. TaylorMotion gives an approximate motion x(t), polynomials step by step. What it fails the
/// equations by is a defect with |defect| <= d. Where errors near it change at a rate of at most mu, the distance r of
/// the exact motion from it grows by
///
///     r' <= mu r + d
///
/// (Dahlquist's lemma; Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, 1993, section I.10). Here
/// mu is a bound of the logarithmic norm in a tube about x(t), piece by piece of a step. The tube is wider than r turns
/// out to be, so that the exact motion cannot have left it. Nothing that TaylorMotion computes is believed.
///
/// Errors of positions are measured by a rate omega, see ErrorGrowth. It may be another for each piece, as where a
/// stiff force acts for a short time. This finds the steps, the tubes and the pieces. StepBounds shows that they serve.
class ProvedMotion {
 public:
  /// The motion from the start of the scene until a time, in the digits of the scope.
  /// \param exact  the scene assembled with at least twice the digits; it and `problem` outlive this
  /// \param omega  the rate by which to measure errors at a time: any positive numbers serve
  /// \param while_working is called many times a step, and may throw to end the work
  ProvedMotion(const Assembled<Mpfr>& exact, const Assembled<Mpfr>& rounded, const Mpfr& until,
               std::function<double(double)> omega, const std::function<void()>& while_working = {});

  /// The state at t, not before the last. \throws BoundsTooWide, and IntegrationError where nothing can be proved
  /// \param after_step is called with the time after every step, and may throw to end the work
  ProvedState at(const RealBall& t, const std::function<void(double)>& after_step = {});

  /// The step under way: with those before it, it is what has been proved.
  const ProvedStep& step() const { return *proved_; }
  /// Called with each step when it ends.
  std::function<void(const ProvedStep&)> keep = {};

  long steps() const { return motion_.steps() + 1; }
  Index order() const { return motion_.order(); }
  /// The natural logarithm of what the bounds have let errors grow by.
  double growth() const { return growth_; }

 private:
  /// Polynomials of the step that TaylorMotion has begun, no longer than is asked for.
  void begin_step();
  /// The bounds of the step, from a distance at its start.
  void take_up(const ErrorDistance& before);
  /// The step's defect, of as much of the step as has bounds.
  Defect defect_of_step();
  /// The step in equal pieces.
  std::vector<PieceEnd> pieces(int count) const;
  double time_at(const RealBall& s) const;
  /// "nothing can be proved beyond t = 2: ..."
  std::string beyond(const std::string& why) const;

  StepBounds bounds_;
  std::function<double(double)> omega_;
  Mpfr until_;
  TaylorMotion motion_;
  std::optional<SeriesStep> step_;
  std::optional<ProvedStep> proved_;
  StepCourse course_;
  RealBall start_;  ///< time of the start of the step, exactly
  int count_ = 4;
  double growth_ = 0;
};

}  // namespace hbvm::core

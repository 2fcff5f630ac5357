#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "hbvm/error.hpp"
#include "reference/proof/defect.hpp"
#include "reference/proof/error_growth.hpp"
#include "reference/taylor_step.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {

/// The state at a time, each component between bounds that are proved.
struct ProvedState {
  std::vector<RealBall> q, p, lambda;
  RealBall H;
};

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
/// stiff force acts for a short time. An error that is measured by omega is at most max(1, omega'/omega) times as long
/// by omega'.
class ProvedMotion {
 public:
  /// The motion from the start of the scene until a time, in the digits of the scope.
  /// \param exact  the scene assembled with at least twice the digits; it and `problem` outlive this
  /// \param omega  the rate by which to measure errors at a time: any positive numbers serve
  /// \param while_working is called many times a step, and may throw to end the work
  ProvedMotion(const Assembled<Mpfr>& exact, const Assembled<Mpfr>& rounded, const Mpfr& until,
               std::function<double(double)> omega, std::function<void()> while_working = {});

  /// The state at t, not before the last. \throws BoundsTooWide, and IntegrationError where nothing can be proved
  /// \param after_step is called with the time after every step, and may throw to end the work
  ProvedState at(const RealBall& t, const std::function<void(double)>& after_step = {});

  long steps() const { return motion_.steps() + 1; }
  Index order() const { return motion_.order(); }
  /// The natural logarithm of what the bounds have let errors grow by.
  double growth() const { return growth_; }

 private:
  /// A part of a step.
  struct Piece {
    RealBall end;  ///< in units of the step's series
    double omega;
    RealBall rate, defect;  ///< of errors, and of the approximate motion
    RealBall tube;
  };
  /// How far the exact motion is from the approximate one.
  struct Distance {
    RealBall length;
    double omega;  ///< by which it is measured

    Distance measured_by(double other) const;
  };
  /// Polynomials of the step that TaylorMotion has begun, no longer than is asked for.
  void begin_step();
  void take_up();
  /// The step's defect, of as much of the step as has bounds.
  Defect defect_of_step();
  /// Pieces of the step, with bounds in a tube of that radius, if it is measured by the rate at the start of the step.
  std::vector<Piece> pieces(const Defect& defect, const Distance& tube, int count, double& total) const;
  /// Whether the distance is less than the tube's radius all the time.
  bool stays_in_tube() const;
  /// The distance after so long a time in a piece, at any of the times in a ball.
  static Distance passed(Distance distance, const Piece& piece, const RealBall& time);
  /// The distance at s of the step, from what it is at the start.
  Distance distance_at(const RealBall& s) const;
  /// Where the exact motion is at s, if it is no farther away than that.
  PathBox box(const SeriesStep& step, const RealBall& s, const Distance& distance) const;
  /// The length of an error of the start of the step.
  RealBall length(const std::vector<RealBall>& dq, const std::vector<RealBall>& dv, double omega) const;
  double time_at(const RealBall& s) const;
  [[noreturn]] void refuse(const std::string& why) const;
  /// "nothing can be proved beyond t = 2: ..."
  std::string beyond(const std::string& why) const;

  const Problem<Mpfr>& problem_;
  BallProblem balls_;
  DefectBound bound_;
  ErrorGrowthIn growth_in_;
  std::function<double(double)> omega_;
  slong bits_;
  Mpfr until_;
  std::function<void()> while_working_;
  TaylorMotion motion_;
  std::optional<SeriesStep> step_;
  std::vector<Piece> pieces_;
  RealBall start_;     ///< time of the start of the step
  Distance distance_;  ///< there
  int count_ = 4;
  double growth_ = 0;
};

}  // namespace hbvm::core

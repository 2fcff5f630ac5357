#pragma once

#include <memory>

#include "ball_stages.hpp"
#include "error_frame.hpp"
#include "hbvm/error.hpp"
#include "scene/assemble.hpp"
#include "solver/stage_solver.hpp"

namespace hbvm::core {

/// A state of the exact discrete motion, each component between bounds.
struct DiscreteState {
  std::vector<RealBall> q, p, g;
  RealBall kinetic, potential;

  RealBall H() const { return kinetic + potential; }
};

/// Bounds became so wide that they prove nothing more; with more digits they may.
class CourseTooWide : public IntegrationError {
 public:
  using IntegrationError::IntegrationError;
};

/// Steps of HBVM(k, s) without any rounding, between bounds. An ordinary solver finds an approximate solution of each
/// step's equations, of which nothing is believed. Krawczyk's test proves that there is an exact one, and but one in
/// a box. The same is proved of the step back, which therefore leads to where the step began. The exact state is the
/// approximate one and an error in a frame. The mean value theorem takes that error through the step.
class ProvedCourse {
 public:
  /// In the digits of the scope. `exact`, which has at least twice as many, and `rounded` outlive this.
  ProvedCourse(const Assembled<Mpfr>& exact, const Assembled<Mpfr>& rounded, const Hbvm<Mpfr>& method, RealBall h);

  /// \throws CourseTooWide, and IntegrationError where the step cannot be proved
  void step();

  long steps() const { return steps_; }
  DiscreteState state() const;
  /// Those of the last step, (57).
  const std::vector<RealBall>& multipliers() const { return multipliers_; }
  /// Each step's equations, forward and back, have no other solution as near as that. It is in units of the momenta,
  /// and of multipliers that would change these so much within a step.
  const RealBall& radius() const { return radius_; }
  /// How large momenta and multipliers of the last step are, by the forces also of a motion that hardly moves.
  const RealBall& momentum_size() const { return momentum_size_; }
  const RealBall& multiplier_size() const { return multiplier_size_; }

 private:
  StageBox centre() const;
  /// Those of the unknowns.
  std::vector<RealBall> units(const StageBox& centre);
  /// Equations of a step near an approximate root: their start is off by the error, which is between bounds.
  struct Near {
    StageBox middle;
    StageImage image;  ///< of the middle
    BallMatrix error;
    std::vector<RealBall> units;

    /// All starts, and unknowns within so many units.
    StageBox box(const RealBall& radius) const;
  };
  Near near(StageBox middle, BallMatrix error, std::vector<RealBall> units) const;
  /// Proves that there is one root in the box of `radius_`, or else in a smaller one, whose radius that is then.
  /// \return how far it is from the middle at most, in units
  RealBall distance_of_root(const Near& near);
  [[noreturn]] void refuse(const Near& near) const;
  /// The state becomes that at the end, less a correction. Its error becomes what the map makes of it.
  void move_to(const BallMatrix& end, const BallMatrix& correction, const BallMatrix& map);

  const Problem<Mpfr>& problem_;
  const Hbvm<Mpfr>& method_;
  slong bits_;
  BallProblem balls_;
  BallMethod ball_method_;
  RealBall h_;
  BallStages stages_;
  std::unique_ptr<StageSolver<Mpfr>> solver_;
  Mpfr rounded_h_;
  Vector<Mpfr> q_, p_;  ///< near the exact state
  ErrorFrame error_;
  std::vector<RealBall> multipliers_;
  RealBall radius_, momentum_size_, multiplier_size_;
  long steps_ = 0;
};

}  // namespace hbvm::core

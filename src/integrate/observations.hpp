#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "integrate/observer.hpp"
#include "integrate/seen_quantity.hpp"
#include "problem/effect/execution.hpp"
#include "problem/effect/term.hpp"
#include "problem/redundant_constraints.hpp"
#include "problem/state_evaluator.hpp"

namespace hbvm::core {

/// Adds full turns to an angle, so that it is the nearest to another.
template <Scalar S>
void turn_towards(S& angle, const S& other) {
  using std::atan, std::floor;
  const S turn = 8 * atan(S(1));
  angle += turn * floor(S((other - angle) / turn + S(1) / 2));
}

/// The values of a scene's observations along the motion. They are formulas of what SeenQuantities names. An angle of
/// the plane goes on over full turns. It is the one nearest to where its rates at both ends of the step lead.
template <Scalar S>
class Observations final : public Observer<S> {
 public:
  /// Scene and problem must outlive it.
  /// \throws InputError with file, line and what is wrong
  Observations(const Scene& scene, const Problem<S>& problem);

  /// \throws InputError for a value that is not finite at the start, and IntegrationError later
  void observe(const Snapshot<S>& snapshot) override;
  /// The same for a state by itself: angles are in (-pi, pi].
  const Vector<S>& see(const S& t, const Vector<S>& q, const Vector<S>& p);
  /// And with each angle of the plane turned to the one nearest to what angles() was at that time.
  const Vector<S>& see(const S& t, const Vector<S>& q, const Vector<S>& p, const Vector<S>& angles);
  /// Each angle of the plane that the formulas hold, at the mesh point observed last; 0 in place of other quantities.
  const Vector<S>& angles() const { return angles_; }
  /// How fast the fastest of them grows, or shrinks, there.
  S greatest_rate() const { return max_norm(rates_); }
  bool has_angles() const;
  /// Whether an observation is such an angle itself.
  bool is_angle(Index observation) const;
  /// Those at the state seen last, one for each observation.
  const Vector<S>& values() const { return values_; }
  /// The least and the greatest value of each observation at the mesh points observed, and when it was first met.
  struct Extremes {
    Vector<S> values, times;
  };
  const Extremes& least() const { return least_; }
  const Extremes& greatest() const { return greatest_; }
  void remember(Archive& archive) override {
    archive(angles_, rates_, last_t_, least_.values, least_.times, greatest_.values, greatest_.times);
  }

 private:
  /// One observation: a program of quantities, or one of them.
  struct Formula {
    std::vector<std::size_t> quantities;
    EffectTerm<S> term;
    Matrix<S> inputs;
    std::unique_ptr<Execution<S>> execution;
  };
  void add(const SceneObservation& observation, const SeenQuantities<S>& quantities);
  void take(const S& t, const Vector<S>& q, const Vector<S>& p);
  void evaluate_all(bool at_start);

  const Scene& scene_;
  const Problem<S>& problem_;
  StateEvaluator<S> point_;
  RedundantConstraints<S> redundant_;
  std::vector<std::string> names_;  // of the quantities
  std::vector<SeenQuantity<S>> quantities_;
  std::vector<std::unique_ptr<Formula>> formulas_;
  SeenState<S> state_;
  Vector<S> seen_;            // of the quantities
  Vector<S> values_;          // of the observations
  Vector<S> angles_, rates_;  // of the quantities that are angles, at the mesh point before
  S last_t_ = 0;
  Extremes least_, greatest_;
};

}  // namespace hbvm::core

#pragma once

#include <optional>
#include <vector>

#include "integrate/between_steps.hpp"
#include "integrate/observations.hpp"

namespace hbvm::core {

/// A crossing of 0 by the value of an event of the scene, with the state there.
template <Scalar S>
struct FoundEvent {
  std::size_t event = 0;  ///< its place in the scene
  bool rises = false;     ///< the value is negative before
  bool grazes = false;    ///< it comes to 0, as near as rounding tells, and turns back
  StateBetween<S> state;
  Vector<S> observed;  ///< values of the scene's observations there
};

/// The event that ends a run: which, and the how many-th.
struct LastEvent {
  std::size_t event = 0;
  long count = 1;
};

/// Thrown where that happened: the run is then made again until there.
struct EventReached {
  std::string t;
};

/// Finds where the values of a scene's events cross 0. In each step they are looked at in 24 places, on the cubic that
/// has positions and velocities of both ends. Where they change sign, or come so near to 0 that they might, the motion
/// itself decides, by steps from the mesh point before. A crossing is found to the working precision. Two that are
/// nearer than a fiftieth of the step, between which the value hardly leaves 0, may be missed.
template <Scalar S>
class EventFinder final : public Observer<S> {
 public:
  /// \throws InputError for an event that cannot be evaluated
  EventFinder(const Scene& scene, const Problem<S>& problem, BetweenSteps<S>& between, std::optional<LastEvent> last);

  /// \throws EventReached
  void observe(const Snapshot<S>& snapshot) override;

  const std::vector<FoundEvent<S>>& found() const { return found_; }

 private:
  static constexpr int parts = 24;

  /// A time of the step and the value of the event there.
  struct Sample {
    S t, value;
  };

  void look_between(const Snapshot<S>& end, const StateBetween<S>& state);
  void look_at(std::size_t event, const std::vector<Vector<S>>& values, const std::vector<S>& times);
  Sample exact(std::size_t event, const S& t);
  /// A crossing between two times, if the motion itself has one.
  bool cross(std::size_t event, const Sample& before, const Sample& after);
  void find_crossing(std::size_t event, Sample before, Sample after);
  /// Looks for the least |value| between two times, and for crossings if that is beyond 0.
  void look_for_turn(std::size_t event, const Sample& before, const Sample& after, const S& size);
  void add(std::size_t event, const S& t, bool rises, bool grazes);

  const Scene& scene_;
  Scene as_observations_;
  const Problem<S>& problem_;
  BetweenSteps<S>& between_;
  std::optional<LastEvent> last_;  // which, and how many are left
  Observations<S> functions_;
  std::optional<Observations<S>> seen_;  // where the scene observes something
  StateEvaluator<S> point_;
  Snapshot<S> mesh_;       // the mesh point before
  StateBetween<S> state_;  // and the output state there
  Vector<S> velocity_;     // with that of driven points
  Vector<S> values_;       // and the values of all events
  std::vector<FoundEvent<S>> found_, of_step_;
};

}  // namespace hbvm::core

#include "integrate/event_finder.hpp"

#include <algorithm>
#include <cmath>

#include "scalar/text.hpp"
#include "scene/add_event.hpp"

namespace hbvm::core {
namespace {

template <Scalar S>
bool is_below(const S& x) {
  return x < 0;
}

/// The value where the parabola through three values at -1, 0, 1 turns. Nothing if that is not between.
template <Scalar S>
std::optional<S> value_at_turn(const S& a, const S& b, const S& c) {
  const S slope = (c - a) / 2, bend = (a + c) / 2 - b;
  if (bend == 0 || magnitude(slope) > 2 * magnitude(bend)) return std::nullopt;
  return b - slope * slope / (4 * bend);
}

}  // namespace

template <Scalar S>
EventFinder<S>::EventFinder(const Scene& scene, const Problem<S>& problem, BetweenSteps<S>& between,
                            std::optional<LastEvent> last)
    : scene_(scene),
      as_observations_(with_events_observed(scene)),
      problem_(problem),
      between_(between),
      last_(last),
      functions_(as_observations_, problem),
      point_(problem) {
  if (!scene.observations.empty()) seen_.emplace(scene, problem);
}

template <Scalar S>
void EventFinder<S>::observe(const Snapshot<S>& snapshot) {
  functions_.observe(snapshot);
  const Vector<S> values = functions_.values();
  const StateBetween<S> state = between_.output(snapshot);
  of_step_.clear();
  if (seen_) seen_->observe(snapshot);
  if (snapshot.n > 0) look_between(snapshot, state);
  std::stable_sort(of_step_.begin(), of_step_.end(), [](const FoundEvent<S>& a, const FoundEvent<S>& b) {
    return magnitude(a.state.t) < magnitude(b.state.t);
  });
  for (FoundEvent<S>& event : of_step_) {
    found_.push_back(std::move(event));
    const FoundEvent<S>& found = found_.back();
    if (last_ && found.event == last_->event && --last_->count == 0)
      throw EventReached{to_text(magnitude(found.state.t))};
  }
  mesh_ = snapshot;
  state_ = state;
  values_ = values;
  velocity_ = Vector<S>::Zero(state.q.size());
  point_.set_velocity(state.q, state.p, velocity_);
}

template <Scalar S>
void EventFinder<S>::look_between(const Snapshot<S>& end, const StateBetween<S>& state) {
  const S h = end.t - mesh_.t;
  Vector<S> velocity = Vector<S>::Zero(state.q.size());
  point_.set_velocity(state.q, state.p, velocity);
  const Vector<S> end_values = functions_.values(), angles = functions_.angles();
  std::vector<Vector<S>> values{values_};
  std::vector<S> times{mesh_.t};
  for (int i = 1; i < parts; ++i) {
    const S x = S(i) / S(parts), y = 1 - x;
    const S a = y * y * (1 + 2 * x), b = x * x * (1 + 2 * y), c = x * y * y * h, d = -x * x * y * h;
    const Vector<S> q = a * state_.q + b * state.q + c * velocity_ + d * velocity;
    const S e = 6 * x * y / h, f = y * (1 - 3 * x), g = x * (1 - 3 * y);
    const Vector<S> v = e * (state.q - state_.q) + f * velocity_ + g * velocity;
    Vector<S> p = y * state_.p + x * state.p;  // of driven coordinates, the work done
    const Index bodies = problem_.mass.of_bodies();
    p.head(bodies) = problem_.mass.momentum(v).head(bodies);
    times.push_back(mesh_.t + x * h);
    values.push_back(functions_.see(times.back(), q, p, angles));
  }
  times.push_back(end.t);
  values.push_back(end_values);
  for (std::size_t event = 0; event < scene_.events.size(); ++event) look_at(event, values, times);
}

template <Scalar S>
void EventFinder<S>::look_at(std::size_t event, const std::vector<Vector<S>>& values, const std::vector<S>& times) {
  const auto e = static_cast<Index>(event);
  S least = values.front()[e], greatest = least;
  for (const Vector<S>& value : values) {
    if (value[e] < least) least = value[e];
    if (value[e] > greatest) greatest = value[e];
  }
  // What the cubic may be off by, in a step that resolves the motion.
  const S margin = (greatest - least) / 32, size = std::max(magnitude(greatest), magnitude(least));
  if (least > margin || greatest < -margin) return;
  // The ends are those of the run itself; in between the motion decides.
  const auto sample = [&](std::size_t i) {
    return i == 0 || i + 1 == times.size() ? Sample{times[i], values[i][e]} : exact(event, times[i]);
  };
  std::size_t looked_until = 0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    const S &before = values[i - 1][e], &after = values[i][e];
    if (is_below(before) != is_below(after)) {
      if (!cross(event, sample(i - 1), sample(i))) {
        // The cubic misjudged where: a little wider.
        const std::size_t from = std::max<std::size_t>(i, 2) - 2, to = std::min(i + 1, times.size() - 1);
        if (from >= looked_until) {
          const Sample a = sample(from), b = sample(to);
          if (!cross(event, a, b)) look_for_turn(event, a, b, size);
          looked_until = to;
        }
      }
      continue;
    }
    if (i + 1 >= times.size() || i < looked_until) continue;
    const S& next = values[i + 1][e];
    if (is_below(after) != is_below(next)) continue;
    const std::optional<S> turn = value_at_turn(before, after, next);
    if (!turn) continue;
    const S towards = is_below(after) ? S(-*turn) : *turn;
    const bool turns_back = (before + next - 2 * after > 0) != is_below(after);
    if (!turns_back || towards > margin) continue;
    look_for_turn(event, sample(i - 1), sample(i + 1), size);
    looked_until = i + 1;
  }
}

template <Scalar S>
typename EventFinder<S>::Sample EventFinder<S>::exact(std::size_t event, const S& t) {
  const StateBetween<S> state = between_.from(state_, t);
  return {t, functions_.see(t, state.q, state.p, functions_.angles())[static_cast<Index>(event)]};
}

template <Scalar S>
bool EventFinder<S>::cross(std::size_t event, const Sample& before, const Sample& after) {
  if (is_below(before.value) == is_below(after.value)) return false;
  try {
    find_crossing(event, before, after);
  } catch (const IntegrationError&) {  // it has no value there: a pole
  }
  return true;
}

template <Scalar S>
void EventFinder<S>::find_crossing(std::size_t event, Sample before, Sample after) {
  const bool rises = is_below(before.value);
  const S size = std::max(magnitude(before.value), magnitude(after.value));
  // The rule of false position; an end that stays counts for half.
  constexpr int most = 400;
  const S width = 2 * epsilon<S>() * std::max(magnitude(before.t), magnitude(after.t));
  S a = before.value, b = after.value;
  int stayed = 0;
  for (int n = 0; n < most && magnitude(S(after.t - before.t)) > width && after.value != 0; ++n) {
    S t = after.t - b * (after.t - before.t) / (b - a);
    // Now and then by halves, so that the width falls, whatever the value does.
    constexpr int now_and_then = 6;
    if (n % now_and_then == now_and_then - 1 || !(magnitude(S(t - before.t)) < magnitude(S(after.t - before.t))) ||
        t == before.t || t == after.t)
      t = (before.t + after.t) / 2;
    if (t == before.t || t == after.t) break;
    const Sample middle = exact(event, t);
    if (is_below(middle.value) == is_below(before.value)) {
      before = middle;
      a = middle.value;
      b = stayed == 1 ? S(b / 2) : after.value;
      stayed = 1;
    } else {
      after = middle;
      b = middle.value;
      a = stayed == -1 ? S(a / 2) : before.value;
      stayed = -1;
    }
  }
  // A value that jumps over 0, as that of a fraction does, has no zero there.
  const S left = std::min(magnitude(before.value), magnitude(after.value));
  if (16 * left > size) return;
  add(event, after.t, rises, false);
}

template <Scalar S>
void EventFinder<S>::look_for_turn(std::size_t event, const Sample& before, const Sample& after, const S& size) {
  using std::sqrt;
  if (is_below(before.value) != is_below(after.value)) {
    cross(event, before, after);
    return;
  }
  const bool below = is_below(before.value);
  const auto height = [&](const Sample& sample) { return below ? S(-sample.value) : sample.value; };
  // The golden section: the value is least within.
  const S ratio = (sqrt(S(5)) - 1) / 2, enough = sqrt(epsilon<S>()) * magnitude(S(after.t - before.t));
  S from = before.t, to = after.t;
  Sample left = exact(event, S(to - ratio * (to - from))), right = exact(event, S(from + ratio * (to - from)));
  while (magnitude(S(to - from)) > enough && height(left) >= 0 && height(right) >= 0) {
    if (height(left) < height(right)) {
      to = right.t;
      right = left;
      left = exact(event, S(to - ratio * (to - from)));
    } else {
      from = left.t;
      left = right;
      right = exact(event, S(from + ratio * (to - from)));
    }
  }
  const Sample& lowest = height(left) < height(right) ? left : right;
  if (height(lowest) < 0) {
    cross(event, before, lowest);
    cross(event, lowest, after);
  } else if (height(lowest) <= sqrt(epsilon<S>()) * size) {
    add(event, lowest.t, below, true);
  }
}

template <Scalar S>
void EventFinder<S>::add(std::size_t event, const S& t, bool rises, bool grazes) {
  const Crossing wanted = scene_.events[event].direction;
  if (!grazes && wanted != Crossing::any && (wanted == Crossing::up) != rises) return;
  FoundEvent<S> found{event, rises, grazes, between_.from(state_, t), {}};
  if (seen_) found.observed = seen_->see(t, found.state.q, found.state.p, seen_->angles());
  of_step_.push_back(std::move(found));
}

#define HBVM_DEFINE(S) template class EventFinder<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

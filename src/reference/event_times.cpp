#include "reference/event_times.hpp"

#include <algorithm>
#include <cmath>

#include "integrate/event_finder.hpp"
#include "integrate/integrate.hpp"
#include "linear/vector_text.hpp"
#include "problem/driven_course.hpp"
#include "reference/usual_step.hpp"
#include "scalar/literal.hpp"
#include "scalar/log2_of.hpp"
#include "scalar/text.hpp"
#include "scene/add_event.hpp"
#include "step/hbvm_method.hpp"

namespace hbvm::core {
namespace {

constexpr int stages = 12, digits_of_first_times = 40;

struct FirstTime {
  std::size_t event;
  bool rises;
  std::string t;
};

/// What a run of few digits finds.
std::vector<FirstTime> first_times(const ReferenceRequest& request) {
  const PrecisionScope few(digits_of_first_times);
  const Scene& scene = request.scene;
  const Expression& until = request.times.back();
  const Assembled<Mpfr> assembled = assemble<Mpfr>(scene);
  const MethodPtr method = hbvm_of({2 * stages, stages});
  const TimeGrid<Mpfr> grid(usual_step(scene, until), until, scene.constants, Direction::forward, LastStep::shortened);
  BetweenSteps<Mpfr> between(method->make_stepper<Mpfr>(assembled.problem, SolverKind::automatic));
  EventFinder<Mpfr> finder(scene, assembled.problem, between, {});
  State<Mpfr> state(assembled.q0, assembled.p0);
  const std::unique_ptr<Stepper<Mpfr>> stepper = method->make_stepper<Mpfr>(assembled.problem, SolverKind::automatic);
  integrate<Mpfr>(*stepper, state, grid, {&finder});
  std::vector<FirstTime> times;
  for (const FoundEvent<Mpfr>& found : finder.found())
    if (!found.grazes) times.push_back({found.event, found.rises, to_text(found.state.t)});
  return times;
}

/// Moves times to where values are 0.
class TimeFinder {
 public:
  explicit TimeFinder(const ReferenceRequest& request)
      : request_(request),
        scene_(assemble<Mpfr>(request.scene)),
        point_(scene_.problem),
        seen_(with_events_observed(request.scene)),
        values_(seen_, scene_.problem) {}

  struct Moved {
    std::size_t event;
    bool rises;
    Mpfr t;
  };

  /// One step of Newton's method. \return the greatest move, over the time
  double improve(std::vector<Moved>& events, const std::vector<ReferenceState>& states) {
    double most = -HUGE_VAL;
    for (std::size_t n = 0; n < events.size(); ++n) {
      Moved& event = events[n];
      const Vector<Mpfr> q = with_driven(scene_.problem, vector_of<Mpfr>(states[n].q), event.t);
      Vector<Mpfr> p = Vector<Mpfr>::Zero(q.size());
      p.head(scene_.problem.mass.of_bodies()) = vector_of<Mpfr>(states[n].p);
      const Mpfr now = value(event, event.t, q, p), rate = rate_of(event, q, p);
      if (rate == 0) throw IntegrationError("event '" + request_.scene.events[event.event].name + "' grazes 0");
      const Mpfr move = now / rate;
      event.t -= move;
      if (move != 0) most = std::max(most, log10_of(move) - log10_of(event.t));
    }
    return most;
  }

 private:
  Mpfr value(const Moved& event, const Mpfr& t, const Vector<Mpfr>& q, const Vector<Mpfr>& p) {
    return values_.see(t, q, p)[static_cast<Index>(event.event)];
  }
  /// Along the motion, by a central difference: it decides how fast the iteration is, and not where it ends.
  Mpfr rate_of(const Moved& event, const Vector<Mpfr>& q, const Vector<Mpfr>& p) {
    const Mpfr step = event.t * pow(Mpfr(10), -static_cast<int>(digits10<Mpfr>()) / 3);
    Vector<Mpfr> v = Vector<Mpfr>::Zero(q.size());
    point_.set_velocity(q, p, v);
    const Vector<Mpfr> change = point_.force(q, p);
    const Mpfr after = value(event, Mpfr(event.t + step), q + step * v, p + step * change),
               before = value(event, Mpfr(event.t - step), q - step * v, p - step * change);
    return (after - before) / (2 * step);
  }

  const ReferenceRequest& request_;
  Assembled<Mpfr> scene_;
  StateEvaluator<Mpfr> point_;
  Scene seen_;
  Observations<Mpfr> values_;
};

}  // namespace

std::vector<EventTime> event_times(const ReferenceRequest& request) {
  std::vector<TimeFinder::Moved> events;
  const PrecisionScope scope(static_cast<unsigned>(std::max(request.digits, digits_of_first_times) + 20));
  // A number keeps the digits that it was made with, also where another is assigned to it.
  for (const FirstTime& first : first_times(request))
    events.push_back({first.event, first.rises, literal<Mpfr>(first.t)});
  if (events.empty()) return {};
  TimeFinder finder(request);
  ReferenceRequest wanted = request;
  wanted.digits = std::min(request.digits + 8, most_reference_digits);
  constexpr int most = 8, beyond = 4;
  for (int n = 0;; ++n) {
    wanted.times.clear();
    for (const TimeFinder::Moved& event : events) wanted.times.push_back(Expression::parse(to_text(Mpfr(event.t))));
    const double moved = finder.improve(events, compute_reference(wanted).times);
    if (moved < -(request.digits + beyond)) break;
    if (n == most) throw IntegrationError("the times of events do not settle");
  }
  std::vector<EventTime> times;
  for (const TimeFinder::Moved& event : events)
    times.push_back({request.scene.events[event.event].name, event.rises,
                     Expression::parse(to_scientific(event.t, request.digits + beyond))});
  return times;
}

}  // namespace hbvm::core

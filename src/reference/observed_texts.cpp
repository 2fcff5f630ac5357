#include "reference/observed_texts.hpp"

#include <algorithm>
#include <cmath>

#include "integrate/observations.hpp"
#include "interruption.hpp"
#include "reference/taylor.hpp"
#include "scalar/literal.hpp"
#include "scalar/text.hpp"

namespace hbvm::core {
namespace {

void shake(Vector<Mpfr>& x) {
  constexpr int least = 64;
  Index i = 0;
  // Units of its own last digit: a state may have fewer than the scope.
  for (Mpfr& entry : x) {
    const auto bits = static_cast<int>(mpfr_get_prec(raw(entry)));
    entry += ldexp(Mpfr(entry * static_cast<int>(least + i++)), 1 - bits);
  }
}

/// The first value to the digits in which no other differs, at most those that were asked for.
std::string agreed_text(const std::vector<Mpfr>& x, int digits) {
  using std::floor, std::log10;
  Mpfr difference = 0;
  for (const Mpfr& other : x) raise_to(difference, magnitude(Mpfr(other - x.front())));
  const Mpfr size = magnitude(x.front());
  if (size <= difference) return "0";
  long agreed = digits + 1;
  if (difference > 0) agreed = std::min(agreed, static_cast<long>(floor(log10(Mpfr(size / difference)))));
  return rounded_text(to_text(x.front()), static_cast<int>(std::max(1L, agreed)));
}

/// The angles that a scene observes at each time, over full turns. A motion with few digits follows them.
class Turns {
 public:
  Turns(const ReferenceRequest& request, double digits_lost)
      : scope_(static_cast<unsigned>(few + std::clamp(digits_lost, double{0}, most_lost))),
        scene_(assemble<Mpfr>(request.scene)),
        observations_(request.scene, scene_.problem),
        motion_(scene_.problem, scene_.q0, scene_.p0, [] { end_if_asked(unfinished); }) {
    look(Mpfr(0));
    for (const Expression& time : request.times) {
      follow(evaluate<Mpfr>(time, request.scene.constants));
      angles_.push_back(observations_.angles());
    }
  }

  const std::vector<Vector<Mpfr>>& angles() const { return angles_; }

 private:
  static constexpr const char* unfinished = "the angles of the reference were not followed to their end";
  static constexpr int few = 18;
  static constexpr double most_lost = 1000;

  /// No further at a time than the fastest angle grows by a radian, nor than the least radius of convergence.
  void follow(const Mpfr& end) {
    while (now_ < end) {
      const Mpfr radius = ldexp(Mpfr(1), static_cast<int>(std::lround(motion_.least_radius())));
      Mpfr most = 1 / std::max(Mpfr(observations_.greatest_rate()), Mpfr(1 / radius));
      if (most > end - now_) most = end - now_;
      const Mpfr next = now_ + most;
      // Of an angle so fast that no time lies between, the digits tell nothing.
      look(next > now_ && next < end ? next : end);
      end_if_asked(unfinished);
    }
  }

  void look(const Mpfr& t) {
    if (t > 0) motion_.advance_to(t);
    observations_.observe({looks_++, t, motion_.q(), motion_.p(), motion_.lambda()});
    now_ = t;
  }

  PrecisionScope scope_;
  Assembled<Mpfr> scene_;
  Observations<Mpfr> observations_;
  TaylorMotion motion_;
  Mpfr now_ = 0;
  long looks_ = 0;
  std::vector<Vector<Mpfr>> angles_;
};

}  // namespace

std::vector<ExactPoint> shaken(std::vector<ExactPoint> points) {
  for (ExactPoint& point : points) {
    shake(point.q);
    shake(point.p);
  }
  return points;
}

void add_observed_texts(Reference& reference, const ReferenceRequest& request, const Problem<Mpfr>& problem,
                        const std::vector<std::vector<ExactPoint>>& points) {
  if (request.scene.observations.empty()) return;
  Observations<Mpfr> observations(request.scene, problem);
  for (const SceneObservation& observation : request.scene.observations)
    reference.observed_names.push_back(observation.name);
  std::vector<Vector<Mpfr>> angles;
  if (observations.has_angles()) angles = Turns(request, reference.digits_lost).angles();
  for (std::size_t n = 0; n < reference.times.size(); ++n) {
    std::vector<std::vector<Mpfr>> values(reference.observed_names.size());
    const Mpfr t = evaluate<Mpfr>(request.times[n], request.scene.constants);
    for (const std::vector<ExactPoint>& found : points) {
      const Vector<Mpfr>& seen = angles.empty() ? observations.see(t, found[n].q, found[n].p)
                                                : observations.see(t, found[n].q, found[n].p, angles[n]);
      for (std::size_t i = 0; i < values.size(); ++i) values[i].push_back(seen[static_cast<Index>(i)]);
    }
    for (const std::vector<Mpfr>& x : values) reference.times[n].observed.push_back(agreed_text(x, request.digits));
  }
}

}  // namespace hbvm::core

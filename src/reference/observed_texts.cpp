#include "reference/observed_texts.hpp"

#include <algorithm>

#include "integrate/observations.hpp"
#include "scalar/literal.hpp"
#include "scalar/text.hpp"

namespace hbvm::core {
namespace {

void shake(Vector<Mpfr>& x) {
  constexpr int least = 64;
  for (Index i = 0; i < x.size(); ++i) x[i] += x[i] * epsilon<Mpfr>() * static_cast<int>(least + i);
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
  for (std::size_t n = 0; n < reference.times.size(); ++n) {
    std::vector<std::vector<Mpfr>> values(reference.observed_names.size());
    const Mpfr t = evaluate<Mpfr>(request.times[n], request.scene.constants);
    for (const std::vector<ExactPoint>& found : points) {
      const Vector<Mpfr>& seen = observations.see(t, found[n].q, found[n].p);
      for (std::size_t i = 0; i < values.size(); ++i) values[i].push_back(seen[static_cast<Index>(i)]);
    }
    for (const std::vector<Mpfr>& x : values) reference.times[n].observed.push_back(agreed_text(x, request.digits));
  }
}

}  // namespace hbvm::core

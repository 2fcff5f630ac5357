#include "run/horizon.hpp"

#include <algorithm>

#include "interruption.hpp"
#include "reference/route_run.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {

Horizon horizon_of(const std::string& precision, double digits, const std::vector<double>& times,
                   const std::vector<double>& lost, double rate) {
  const auto reached = std::find_if(lost.begin(), lost.end(), [&](double x) { return x >= digits; });
  if (reached != lost.end()) return {precision, digits, times[static_cast<std::size_t>(reached - lost.begin())], false};
  if (!(rate > 0)) return {precision, digits, {}, false};
  return {precision, digits, times.back() + (digits - lost.back()) / rate, true};
}

DigitsLost digits_lost(const RunRequest& request, const std::function<void(double)>& progress) {
  if (request.direction == Direction::backward || request.start)
    throw InputError("the horizon is that of the scene's own start, forward in time");
  DigitsLost found;
  try {
    const MotionNature nature = nature_of(request.scene, {request.until}, [&](double part) {
      if (progress) progress(part);
      end_if_asked("the growth of errors was not followed to its end");
    });
    const double end = evaluate<double>(request.until, request.scene.constants);
    const std::size_t parts = nature.grown.size();
    for (std::size_t n = 0; n <= parts; ++n) {
      const double part = static_cast<double>(n) / static_cast<double>(parts);
      found.times.push_back(end * part);
      found.lost.push_back(nature.lost_by(part));
    }
  } catch (const IntegrationError& error) {
    found.failure = error.what();
    return found;
  }
  const std::size_t half = found.lost.size() / 2;
  const double grown = found.lost.back() - found.lost[half];
  const double rate = grown < 1 ? 0 : grown / (found.times.back() - found.times[half]);
  std::vector<Precision> precisions{Precision::parse("double"), Precision::parse("mpfr:34")};
  if (std::none_of(precisions.begin(), precisions.end(),
                   [&](const Precision& p) { return p.name() == request.precision.name(); }))
    precisions.push_back(request.precision);
  for (const Precision& precision : precisions)
    found.horizons.push_back(horizon_of(precision.name(), precision.digits(), found.times, found.lost, rate));
  return found;
}

double lost_by(const DigitsLost& growth, double t) {
  const auto after = std::upper_bound(growth.times.begin(), growth.times.end(), t);
  if (after == growth.times.end()) return growth.lost.back();
  if (after == growth.times.begin()) return growth.lost.front();
  const auto n = static_cast<std::size_t>(after - growth.times.begin());
  const double part = (t - growth.times[n - 1]) / (growth.times[n] - growth.times[n - 1]);
  return growth.lost[n - 1] + part * (growth.lost[n] - growth.lost[n - 1]);
}

}  // namespace hbvm::core

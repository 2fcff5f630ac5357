#include "reference/growth_survey.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "reference/proof/error_growth.hpp"
#include "reference/taylor_step.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

double size_of(const BallMatrix& x) {
  double size = 0;
  for (Index i = 0; i < x.rows(); ++i)
    for (Index j = 0; j < x.columns(); ++j) size = std::max(size, std::abs(centre_of(x(i, j))));
  return size;
}

double square_root_of_size(const BallMatrix& x) { return std::sqrt(size_of(x)); }

/// What is known of errors in the middle of a part of the motion.
struct Sample {
  ErrorGrowth growth;
  double duration, end;
};

/// One of each two, for twice the time.
void thin(std::vector<Sample>& samples) {
  std::vector<Sample> kept;
  for (std::size_t i = 0; i < samples.size(); i += 2) {
    kept.push_back(std::move(samples[i]));
    if (i + 1 == samples.size()) break;
    kept.back().duration += samples[i + 1].duration;
    kept.back().end = samples[i + 1].end;
  }
  samples = std::move(kept);
}

/// Rates in octaves, to both sides of those that forces have.
std::vector<double> candidates(const std::vector<Sample>& samples, double T) {
  double least = 0, greatest = 0;
  for (const Sample& sample : samples) {
    const double rate = std::max({square_root_of_size(sample.growth.A), size_of(sample.growth.B), 1 / T});
    const double octave = std::log2(rate);
    least = &sample == samples.data() ? octave : std::min(least, octave);
    greatest = &sample == samples.data() ? octave : std::max(greatest, octave);
  }
  std::vector<double> result;
  constexpr double beyond = 3;
  for (double octave = std::floor(least - beyond); octave <= greatest + 1; ++octave)
    result.push_back(std::exp2(octave));
  return result;
}

}  // namespace

GrowthSurvey survey_growth(const Scene& scene, const Expression& until, const std::function<void(double)>& progress) {
  constexpr unsigned few_digits = 20;
  constexpr std::size_t most_samples = 1024;
  const PrecisionScope digits(few_digits);
  const BallScope bits(significand_bits<Mpfr>());
  const Assembled<Mpfr> assembled = assemble<Mpfr>(scene);
  const BallProblem balls(assembled.problem);
  const ErrorGrowthIn growth_in(balls);
  const auto T = static_cast<double>(evaluate<Mpfr>(until, scene.constants));
  TaylorMotion motion(assembled.problem, assembled.q0, assembled.p0);
  std::vector<Sample> samples;
  double every = 1, since = 0, duration = 0;
  for (;;) {
    const double start = approximately(motion.start());
    progress(std::min(double{1}, start / T));
    if (start >= T) break;
    const double length = std::min(approximately(motion.length()), T - start);
    duration += length;
    if (++since >= every) {
      const SeriesStep step = step_of(motion, balls);
      RealBall middle = step.end() / RealBall(2);
      arb_get_mid_arb(raw(middle), raw(middle));
      const PathBox at{step.positions(middle), step.velocities(middle), step.accelerations(middle)};
      samples.push_back({growth_in(at, at, middle), duration, start + length});
      since = duration = 0;
      if (samples.size() == 2 * most_samples) {
        thin(samples);
        every *= 2;
      }
    }
    motion.next_step();
  }
  // The path of rates along which errors grow least, by Bellman's principle. Where a rate is higher than before, errors
  // of positions are as much longer.
  const std::vector<double> rates = candidates(samples, T);
  constexpr double infinite = std::numeric_limits<double>::infinity();
  std::vector<double> best(rates.size(), 0);
  std::vector<std::vector<std::size_t>> from;
  for (const Sample& sample : samples) {
    std::vector<double> next(rates.size(), infinite);
    std::vector<std::size_t>& way = from.emplace_back(rates.size());
    for (std::size_t k = 0; k < rates.size(); ++k) {
      for (std::size_t l = 0; l < rates.size(); ++l) {
        const double cost = best[l] + std::max(double{0}, std::log(rates[k] / rates[l]));
        if (cost < next[k]) {
          next[k] = cost;
          way[k] = l;
        }
      }
      next[k] += std::max(double{0}, sample.growth.rate(rates[k])) * sample.duration;
    }
    best = next;
    progress(1);
  }
  GrowthSurvey result;
  result.steps = static_cast<double>(motion.steps());
  auto at = static_cast<std::size_t>(std::min_element(best.begin(), best.end()) - best.begin());
  result.growth = best[at] / std::numbers::ln10;
  for (std::size_t i = samples.size(); i-- > 0;) {
    result.times.push_back(samples[i].end);
    result.omegas.push_back(rates[at]);
    at = from[i][at];
  }
  std::ranges::reverse(result.times);
  std::ranges::reverse(result.omegas);
  return result;
}

double GrowthSurvey::omega_at(double t) const {
  const auto place = static_cast<std::size_t>(std::lower_bound(times.begin(), times.end(), t) - times.begin());
  return omegas[std::min(place, omegas.size() - 1)];
}

}  // namespace hbvm::core

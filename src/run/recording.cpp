#include "run/recording.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "linear/in_double.hpp"

namespace hbvm::core {
namespace {

template <Scalar S>
std::vector<double> list_of(const Vector<S>& x) {
  const Vector<double> rounded = in_double(x);
  return {rounded.begin(), rounded.end()};
}

template <Scalar S>
double decimal_log(const S& x) {
  using std::log10;
  return x > 0 ? approximately(S(log10(x))) : -std::numeric_limits<double>::infinity();
}

}  // namespace

std::vector<std::vector<double>> Recording::states() const {
  std::vector<std::vector<double>> result;
  for (const Sample& sample : samples) result.push_back(sample.q);
  return result;
}

std::vector<std::size_t> shown_multipliers(const Recording& recording) {
  std::vector<std::size_t> all, joints;
  for (const std::string& constraint : recording.constraints) {
    if (!constraint.starts_with("directors ")) joints.push_back(all.size());
    all.push_back(all.size());
  }
  return joints.empty() ? all : joints;
}

Recording Recording::until_lost() const {
  Recording seen = *this;
  if (!std::isfinite(size_of_H)) return seen;
  while (seen.samples.size() > 2 && !(seen.samples.back().energy <= size_of_H)) seen.samples.pop_back();
  return seen;
}

template <Scalar S>
void MotionRecorder<S>::Range::take(const std::vector<double>& values) {
  if (least.empty()) least = greatest = values;
  for (std::size_t i = 0; i < values.size(); ++i) {
    least[i] = std::min(least[i], values[i]);
    greatest[i] = std::max(greatest[i], values[i]);
  }
}

template <Scalar S>
MotionRecorder<S>::MotionRecorder(const Problem<S>& problem, long steps, Recording& recording,
                                  const Observations<S>* observations)
    : problem_(problem),
      point_(problem),
      redundant_(problem),
      steps_(steps),
      recording_(recording),
      observations_(observations),
      v_(problem.m()) {
  recording_.every = std::max(1L, (steps + Recording::most - 1) / Recording::most);
  recording_.steps = steps;
  recording_.constraints = names_of_constraints(problem);
  if (!problem.driven.empty()) recording_.conserved = "H − W";
}

template <Scalar S>
void MotionRecorder<S>::observe(const Snapshot<S>& s) {
  const S H = point_.balance(s.q, s.p);
  if (s.n == 0) {
    H0_ = H;
    const S size = point_.energy_size(s.q, s.p), of_g = point_.constraint_size(s.q);
    recording_.size_of_H = decimal_log(size);
    recording_.round_off = decimal_log(S(epsilon<S>() * (of_g > 0 && of_g < size ? of_g : size)));
  }
  raise_magnitude(energy_, S(H - H0_));
  raise_to(constraints_, max_norm(point_.constraints(s.q)));
  raise_to(constraints_, max_norm(redundant_.values(s.q)));
  raise_to(hidden_, max_norm(point_.hidden_constraints(s.q, s.p)));
  raise_to(hidden_, max_norm(redundant_.hidden(s.q, s.p)));
  const std::vector<double> lambda = list_of<S>(redundant_.multipliers(s.q, s.lambda));
  const std::vector<double> observed = observations_ ? list_of<S>(observations_->values()) : std::vector<double>{};
  lambda_.take(lambda);
  observed_.take(observed);
  if (s.n % recording_.every != 0 && s.n != steps_) return;
  problem_.mass.velocity(lanes(s.p), lanes(v_));
  recording_.samples.push_back({.t = approximately(s.t),
                                .q = list_of<S>(s.q),
                                .lambda = lambda,
                                .energy = decimal_log(energy_),
                                .constraints = decimal_log(constraints_),
                                .hidden = decimal_log(hidden_),
                                .H_change = approximately(S(H - H0_)),
                                .observed = observed,
                                .v = list_of<S>(v_),
                                .least_lambda = lambda_.least,
                                .greatest_lambda = lambda_.greatest,
                                .least_observed = observed_.least,
                                .greatest_observed = observed_.greatest});
  lambda_ = observed_ = {};
  set_zero(energy_);
  set_zero(constraints_);
  set_zero(hidden_);
}

template <Scalar S>
void MotionRecorder<S>::remember(Archive& archive) {
  archive(H0_, energy_, constraints_, hidden_, recording_.size_of_H, recording_.round_off);
  lambda_.remember(archive);
  observed_.remember(archive);
  archive.sized(recording_.samples);
}

#define HBVM_DEFINE(S) template class MotionRecorder<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

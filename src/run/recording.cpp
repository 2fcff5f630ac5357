#include "run/recording.hpp"

#include <algorithm>
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
double log10_of(const S& x) {
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

template <Scalar S>
MotionRecorder<S>::MotionRecorder(const Problem<S>& problem, long steps, Recording& recording,
                                  const Observations<S>* observations)
    : point_(problem), redundant_(problem), steps_(steps), recording_(recording), observations_(observations) {
  recording_.every = std::max(1L, (steps + Recording::most - 1) / Recording::most);
  recording_.steps = steps;
  recording_.constraints = names_of_constraints(problem);
}

template <Scalar S>
void MotionRecorder<S>::observe(const Snapshot<S>& s) {
  const S H = point_.energy(s.q, s.p);
  if (s.n == 0) H0_ = H;
  raise_magnitude(energy_, S(H - H0_));
  raise_to(constraints_, max_norm(point_.constraints(s.q)));
  raise_to(constraints_, max_norm(redundant_.values(s.q)));
  raise_to(hidden_, max_norm(point_.hidden_constraints(s.q, s.p)));
  raise_to(hidden_, max_norm(redundant_.hidden(s.q, s.p)));
  if (s.n % recording_.every != 0 && s.n != steps_) return;
  recording_.samples.push_back({approximately(s.t), list_of<S>(s.q), list_of<S>(redundant_.multipliers(s.q, s.lambda)),
                                log10_of(energy_), log10_of(constraints_), log10_of(hidden_), approximately(S(H - H0_)),
                                observations_ ? list_of<S>(observations_->values()) : std::vector<double>{}});
  set_zero(energy_);
  set_zero(constraints_);
  set_zero(hidden_);
}

template <Scalar S>
void MotionRecorder<S>::remember(Archive& archive) {
  archive(H0_, energy_, constraints_, hidden_);
  archive.sized(recording_.samples);
}

#define HBVM_DEFINE(S) template class MotionRecorder<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

#include "integrate/states_at.hpp"

#include <cmath>

#include "hbvm/error.hpp"
#include "scalar/text.hpp"

namespace hbvm::core {

template <Scalar S>
StatesAt<S>::StatesAt(BetweenSteps<S>& between, std::vector<S> times, Direction direction)
    : between_(between), times_(std::move(times)), direction_(direction) {}

template <Scalar S>
void StatesAt<S>::observe(const Snapshot<S>& snapshot) {
  // Times up to the middle of the step belong to the mesh point before. Where there is no way back all do.
  const S passed = magnitude(snapshot.t), before = magnitude(last_.t);
  const S limit = between_.leads_back() ? S((before + passed) / 2) : passed;
  if (snapshot.n > 0)
    while (next_ < times_.size() && times_[next_] < limit) take(last_);
  while (next_ < times_.size() && times_[next_] == passed) take(snapshot);
  last_ = snapshot;
}

template <Scalar S>
void StatesAt<S>::finish() {
  while (next_ < times_.size()) take(last_);
}

template <Scalar S>
void StatesAt<S>::take(const Snapshot<S>& mesh) {
  const S& t = times_[next_++];
  states_.push_back(between_.at(mesh, direction_ == Direction::backward ? S(-t) : t));
}

template <Scalar S>
std::vector<S> multiples_until(const S& every, const S& until) {
  using std::floor;
  constexpr long most = 10'000'000;
  if (!(every > 0)) throw InputError("--every-time " + to_text(every) + " is not positive");
  const S count = floor(S(until / every * (1 + 4 * epsilon<S>())));
  if (!(count <= S(most))) throw InputError("--every-time " + to_text(every) + ": more than 10^7 states");
  std::vector<S> times;
  for (long n = 0; S(n) <= count; ++n) {
    const S t = every * S(n);
    times.push_back(t < until ? t : until);
  }
  return times;
}

#define HBVM_DEFINE(S)        \
  template class StatesAt<S>; \
  template std::vector<S> multiples_until<S>(const S&, const S&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

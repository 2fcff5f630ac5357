#include "step/halving_stepper.hpp"

#include <algorithm>
#include <optional>

#include "copy_state.hpp"
#include "interruption.hpp"

namespace hbvm::core {

template <Scalar S>
HalvingStepper<S>::HalvingStepper(Make make)
    : make_(std::move(make)), parts_(deepest + 1, S(0)), before_(Vector<S>(), Vector<S>()) {
  const Index m = stepper(0).problem().m();
  before_ = State<S>(Vector<S>::Zero(m), Vector<S>::Zero(m));
}

template <Scalar S>
Stepper<S>& HalvingStepper<S>::stepper(int depth) {
  while (static_cast<int>(steppers_.size()) <= depth) steppers_.emplace_back();
  std::unique_ptr<Stepper<S>>& made = steppers_[static_cast<std::size_t>(depth)];
  if (!made) made = make_(depth);
  return *made;
}

template <Scalar S>
StepResult<S> HalvingStepper<S>::step(State<S>& state, const S& h) {
  if (h != parts_[0])
    for (int depth = 0; depth <= deepest; ++depth) parts_[static_cast<std::size_t>(depth)] = h / S(1L << depth);
  copy_state(before_, state);
  StepResult<S> result;
  long sweeps = 0, substeps = 0;
  int smallest = 0;
  std::optional<StageFailure> first;
  // Time within the step in units of 2^-deepest h.
  constexpr long whole = 1L << deepest;
  for (long done = 0; done < whole;) {
    try {
      result = stepper(depth_).step(state, parts_[static_cast<std::size_t>(depth_)]);
      sweeps += result.sweeps;
    } catch (const StageFailure& failure) {
      sweeps += failure.sweeps();
      if (!first) first = failure;
      // An attempt at twice the last size was in vain.
      if (depth_ < last_) patience_ = std::min(2 * patience_, longest_patience);
      successes_ = 0;
      if (++depth_ <= deepest) {
        end_if_asked("a step is divided");
        continue;
      }
      copy_state(state, before_);
      depth_ = last_ = 0;
      throw StageFailure(first->cause(),
                         first->what() + std::string("; nor could it be made of steps down to 2^-") +
                             std::to_string(deepest) + " of it, where " + failure.what(),
                         first->increment(), sweeps);
    }
    if (depth_ < last_) patience_ = 1;
    last_ = depth_;
    smallest = std::max(smallest, depth_);
    ++substeps;
    done += whole >> depth_;
    if (done < whole) end_if_asked("a step is divided");
    if (depth_ > 0 && ++successes_ >= patience_ && done % (whole >> (depth_ - 1)) == 0) {
      --depth_;
      successes_ = 0;
    }
  }
  if (substeps > 1) {
    if (log_.steps++ == 0) log_.first_step = made_;
    log_.substeps += substeps;
    log_.depth = std::max(log_.depth, smallest);
  }
  ++made_;
  result.sweeps = sweeps;
  return result;
}

template <Scalar S>
SolverCounts HalvingStepper<S>::counts() const {
  SolverCounts sum;
  for (const auto& stepper : steppers_)
    if (stepper) add_counts(sum, stepper->counts(), problem());
  return sum;
}

template <Scalar S>
void HalvingStepper<S>::remember(Archive& archive) {
  archive(made_, depth_, last_, successes_, patience_, log_);
  for (int depth = 0; depth <= deepest; ++depth) {
    const auto i = static_cast<std::size_t>(depth);
    bool made = i < steppers_.size() && steppers_[i];
    archive(made);
    if (made) archive(stepper(depth));
  }
}

#define HBVM_DEFINE(S) template class HalvingStepper<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

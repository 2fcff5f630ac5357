#pragma once

#include <vector>

#include "integrate/between_steps.hpp"
#include "integrate/time_grid.hpp"

namespace hbvm::core {

/// Finds the states of a run at times that need be no mesh points, each from the mesh point that is nearest.
template <Scalar S>
class StatesAt final : public Observer<S> {
 public:
  /// \param times that ascend, from 0 to the end of the run; of one back in time their opposites are meant
  StatesAt(BetweenSteps<S>& between, std::vector<S> times, Direction direction);
  void observe(const Snapshot<S>& snapshot) override;
  /// After the last mesh point: those that are left lie there, but for rounding.
  void finish();

  const std::vector<StateBetween<S>>& states() const { return states_; }

 private:
  void take(const Snapshot<S>& mesh);

  BetweenSteps<S>& between_;
  std::vector<S> times_;
  Direction direction_;
  std::size_t next_ = 0;
  Snapshot<S> last_;
  std::vector<StateBetween<S>> states_;
};

/// The multiples of a time until the end, from 0 on. \throws InputError unless it is positive, and for more than ten
/// million of them
template <Scalar S>
std::vector<S> multiples_until(const S& every, const S& until);

}  // namespace hbvm::core

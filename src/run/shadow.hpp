#pragma once

#include <string>
#include <vector>

#include "hbvm/run.hpp"
#include "integrate/integrate.hpp"
#include "run/run_request.hpp"

namespace hbvm::core {

/// Keeps the states that a shadow is compared with. Those of all mesh points are kept if they are few enough, else
/// those of every `every`-th, and the last.
template <Scalar S>
class ShadowedRun final : public Observer<S> {
 public:
  static constexpr long most_numbers = 1L << 22;

  /// Of m coordinates; it keeps about so many numbers, or less.
  ShadowedRun(Index m, long steps, long numbers = most_numbers);
  void observe(const Snapshot<S>& snapshot) override;
  void remember(Archive& archive) override { archive(states_); }

  /// The same run in more digits. `method` has the k that was chosen; `start` is where it began, if not at the start of
  /// its scene.
  Shadow compare(const RunRequest& request, const Method& method, const std::optional<State<S>>& start) const;

 private:
  long steps_, every_;
  Matrix<S> states_;  ///< q over p, a column a mesh point
};

/// Lines for people: the worst component, or the failure.
std::string to_text(const Shadow& shadow);

}  // namespace hbvm::core

#pragma once

#include "integrate/observer.hpp"
#include "problem/energy_terms.hpp"

namespace hbvm::core {

/// What an energy error is to be compared with. These are maxima over the mesh: of the size of the terms of H, and of
/// what its round-off is proportional to.
template <Scalar S>
class EnergyScale final : public Observer<S> {
 public:
  explicit EnergyScale(const Problem<S>& problem) : terms_(problem) {}
  void observe(const Snapshot<S>& snapshot) override;
  void remember(Archive& archive) override { archive(size_, round_off_size_); }

  const S& size() const { return size_; }

  /// The energy error that rounding explains. Every step and every evaluation of H has epsilon times what H is
  /// sensitive to. Steps, and the terms of its sum, add as independent errors do (Brouwer's law), twice over: 2
  /// sqrt(steps + terms).
  S round_off(long steps) const;

 private:
  EnergyTerms<S> terms_;
  S size_ = 0, round_off_size_ = 0;
};

}  // namespace hbvm::core

#pragma once

#include "integrate/observer.hpp"
#include "problem/momenta.hpp"

namespace hbvm::core {

/// The greatest change over the mesh of each component of momentum that the problem conserves.
template <Scalar S>
class MomentumDrift final : public Observer<S> {
 public:
  MomentumDrift(const Problem<S>& problem, std::vector<MomentumComponent<S>> components)
      : problem_(problem),
        components_(std::move(components)),
        initial_(components_.size(), S(0)),
        drift_(initial_),
        size_(initial_) {}

  void observe(const Snapshot<S>& snapshot) override {
    for (std::size_t i = 0; i < components_.size(); ++i) {
      const auto [value, size] = momentum(problem_, components_[i], snapshot.q, snapshot.p);
      if (snapshot.n == 0) initial_[i] = value;
      raise_to(drift_[i], magnitude(S(value - initial_[i])));
      raise_to(size_[i], size);
    }
  }

  void remember(Archive& archive) override { archive(initial_, drift_, size_); }

  const std::vector<MomentumComponent<S>>& components() const { return components_; }
  const S& initial(std::size_t i) const { return initial_[i]; }
  const S& drift(std::size_t i) const { return drift_[i]; }
  /// The greatest sum of the magnitudes of its terms.
  const S& size(std::size_t i) const { return size_[i]; }

 private:
  const Problem<S>& problem_;
  std::vector<MomentumComponent<S>> components_;
  std::vector<S> initial_, drift_, size_;
};

}  // namespace hbvm::core

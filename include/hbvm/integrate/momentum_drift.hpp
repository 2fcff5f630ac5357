#pragma once

#include "hbvm/integrate/integrate.hpp"
#include "hbvm/problem/momenta.hpp"

namespace hbvm {

/// The greatest change over the mesh of each component of momentum that the problem conserves.
template <Scalar S>
class MomentumDrift final : public Observer<S> {
 public:
  MomentumDrift(const Problem<S>& problem, std::vector<MomentumComponent> components)
      : problem_(problem), components_(std::move(components)), initial_(components_.size(), S(0)), drift_(initial_) {}

  void observe(const Snapshot<S>& snapshot) override {
    for (std::size_t i = 0; i < components_.size(); ++i) {
      const S value = momentum(problem_, components_[i], snapshot.q, snapshot.p);
      if (snapshot.n == 0) initial_[i] = value;
      raise_to(drift_[i], magnitude(S(value - initial_[i])));
    }
  }

  const std::vector<MomentumComponent>& components() const { return components_; }
  const S& initial(std::size_t i) const { return initial_[i]; }
  const S& drift(std::size_t i) const { return drift_[i]; }

 private:
  const Problem<S>& problem_;
  std::vector<MomentumComponent> components_;
  std::vector<S> initial_, drift_;
};

}  // namespace hbvm

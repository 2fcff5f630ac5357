#include "integrate/energy_scale.hpp"

namespace hbvm::core {

template <Scalar S>
void EnergyScale<S>::observe(const Snapshot<S>& snapshot) {
  terms_.evaluate(snapshot.q, snapshot.p);
  raise_to(size_, terms_.size());
  raise_to(round_off_size_, terms_.round_off_size());
}

template <Scalar S>
S EnergyScale<S>::round_off(long steps) const {
  using std::sqrt;
  return epsilon<S>() * round_off_size_ * 2 * sqrt(S(steps + terms_.count()));
}

#define HBVM_DEFINE(S) template class EnergyScale<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

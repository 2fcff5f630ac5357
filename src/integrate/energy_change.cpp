#include "hbvm/integrate/energy_change.hpp"

#include <algorithm>

#include "hbvm/scalar/binary_exponent.hpp"
#include "hbvm/scalar/in_place.hpp"

namespace hbvm {

template <Scalar S>
typename EnergyChange<S>::Bin& EnergyChange<S>::bin(const S& x) {
  const long exponent = binary_exponent(x);
  const auto at = std::lower_bound(bins_.begin(), bins_.end(), exponent,
                                   [](const Bin& bin, long wanted) { return bin.exponent < wanted; });
  if (at != bins_.end() && at->exponent == exponent) return *at;
  Bin added;
  added.exponent = exponent;
  return *bins_.insert(at, added);
}

template <Scalar S>
void EnergyChange<S>::observe(const S& kinetic, const S& error, const S& t) {
  ++bin(kinetic).count;
  set_product(scaled_, error, part_);
  if (!exceeds(scaled_, kinetic)) return;
  Bin& of_error = bin(error);
  if (!of_error.reached) {
    of_error.reached = true;
    set(of_error.first, t);
  }
  if (!exceeds(error, error_)) return;
  set_magnitude(error_, error);
  set(t_, t);
}

template <Scalar S>
S EnergyChange<S>::usual() const {
  long all = 0, below = 0;
  for (const Bin& bin : bins_) all += bin.count;
  for (const Bin& bin : bins_) {
    below += bin.count;
    if (2 * below >= all) return bin.exponent == exponent_of_zero ? S(0) : power_of_two<S>(bin.exponent);
  }
  return 0;
}

template <Scalar S>
typename EnergyChange<S>::Change EnergyChange<S>::change() const {
  Change change;
  change.usual = usual();
  const S least = change.usual / part;
  if (!(error_ > least)) return change;
  change.error = error_;
  change.t = t_;
  for (const Bin& bin : bins_)
    if (bin.reached && power_of_two<S>(bin.exponent - 1) > least && exceeds(change.t, bin.first)) change.t = bin.first;
  return change;
}

#define HBVM_DEFINE(S) template class EnergyChange<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm

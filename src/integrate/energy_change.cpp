#include "integrate/energy_change.hpp"

#include <vector>

#include "scalar/binary_exponent.hpp"
#include "scalar/in_place.hpp"

namespace hbvm::core {

template <Scalar S>
void EnergyChange<S>::remember(Archive& archive) {
  std::vector<long> exponents;
  for (const auto& [exponent, bin] : bins_) exponents.push_back(exponent);
  archive.sized(exponents);
  std::map<long, Bin> bins;
  for (const long exponent : exponents) {
    Bin& bin = bins[exponent] = bins_[exponent];
    archive(bin.count, bin.reached, bin.first);
  }
  bins_.swap(bins);
  archive(error_, t_);
}

template <Scalar S>
void EnergyChange<S>::observe(const S& kinetic, const S& error, const S& t) {
  ++bins_[binary_exponent(kinetic)].count;
  set_product(scaled_, error, part_);
  if (!exceeds(scaled_, kinetic)) return;
  Bin& of_error = bins_[binary_exponent(error)];
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
  for (const auto& [exponent, bin] : bins_) all += bin.count;
  for (const auto& [exponent, bin] : bins_) {
    below += bin.count;
    if (2 * below >= all) return exponent == exponent_of_zero ? S(0) : power_of_two<S>(exponent);
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
  for (const auto& [exponent, bin] : bins_)
    if (bin.reached && power_of_two<S>(exponent - 1) > least && exceeds(change.t, bin.first)) change.t = bin.first;
  return change;
}

#define HBVM_DEFINE(S) template class EnergyChange<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

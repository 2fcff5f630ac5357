#include "problem/gram_factor.hpp"

namespace hbvm::core {

template <Scalar S>
bool GramFactor<S>::factor(ConstraintGradient<S>& gradient, Index nu) {
  std::vector<std::pair<Index, Index>> pairs;
  for (const auto& pair : gradient.couplings())
    if (pair.a >= pair.b) pairs.emplace_back(pair.a, pair.b);
  order_ = order_for_band(nu, pairs);
  lu_.resize(nu, order_.half_bandwidth);
  lu_.set_zero();
  const auto place = [&](Index a) { return order_.position[static_cast<std::size_t>(a)]; };
  S product;
  gradient.for_each_own_coupling(
      Index{1}, &product, [&](Index a, Index b, const auto& at) { set(lu_.entry(place(a), place(b)), at(0, 0)); });
  return lu_.factor();
}

template <Scalar S>
void GramFactor<S>::solve(Vector<S>& x) {
  ordered_.resize(x.size());
  for (Index a = 0; a < x.size(); ++a) ordered_[order_.position[static_cast<std::size_t>(a)]] = x[a];
  lu_.solve(ordered_);
  for (Index a = 0; a < x.size(); ++a) x[a] = ordered_[order_.position[static_cast<std::size_t>(a)]];
}

#define HBVM_DEFINE(S) template class GramFactor<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

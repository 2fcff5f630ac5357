#include "cell.hpp"

#include <algorithm>

#include "hbvm/clock.hpp"

namespace hbvm {

int Cell::stages() const {
  const Claim& claim = subject();
  return claim.tableau ? std::min(claim.tableau->stages(), 20) : claim.method.s;
}

void Cell::check_time() const {
  if (stop_at > 0 && thread_seconds() > stop_at) throw LimitReached("the limit of time was reached");
}

bool Cell::is_lost(const Ladders& ladders) const {
  return std::none_of(ladders.begin(), ladders.end(), [&](const auto& ladder) {
    return asks_for(ladder.first) && (ladder.second.back().is_clean() || ladder.second.back().by_reference);
  });
}

bool Cell::asks_for(Quantity quantity) const {
  return std::any_of(claims.begin(), claims.end(), [&](const Claim& claim) { return claim.quantity == quantity; });
}

}  // namespace hbvm

#include "claim_group.hpp"

#include <algorithm>

#include "clock.hpp"

namespace hbvm::core {

namespace {

/// No order that is asked for needs more.
constexpr int most_stages = 20;

}  // namespace

int ClaimGroup::stages() const { return std::min(subject().method->stages(), most_stages); }

void ClaimGroup::check_time() const {
  if (stop_at > 0 && thread_seconds() > stop_at) throw LimitReached("the limit of time was reached");
}

bool ClaimGroup::is_lost(const Ladders& ladders) const {
  return std::none_of(ladders.begin(), ladders.end(), [&](const auto& ladder) {
    return asks_for(ladder.first) && (ladder.second.back().is_clean() || ladder.second.back().by_reference);
  });
}

bool ClaimGroup::asks_for(Quantity quantity) const {
  return std::any_of(claims.begin(), claims.end(), [&](const Claim& claim) { return claim.quantity == quantity; });
}

}  // namespace hbvm::core

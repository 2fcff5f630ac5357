#include "error_sizes.hpp"

#include <algorithm>

namespace hbvm::core {

void raise(ErrorSizes& sizes, Quantity quantity, double error, double floor) {
  const auto [place, is_new] = sizes.try_emplace(quantity, ErrorSize{error, floor});
  if (is_new) return;
  place->second.error = std::max(place->second.error, error);
  place->second.floor = std::max(place->second.floor, floor);
}

// Four bits more than the estimate.
Margins::Margins(const ReferenceMotion::Errors& errors) : q(errors.q + 4), p(errors.p + 4), lambda(errors.lambda + 4) {}

void Margins::raise(const Margins& other) {
  q = std::max(q, other.q);
  p = std::max(p, other.p);
  lambda = std::max(lambda, other.lambda);
}

}  // namespace hbvm::core

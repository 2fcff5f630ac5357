#pragma once

#include <vector>

#include "reference/agreement.hpp"
#include "reference/compute_reference.hpp"
#include "reference/proof/step_bounds.hpp"

namespace hbvm::core {

/// The scene with more than twice the digits of the scope, of which a proof believes three quarters.
/// \throws InputError for a start that is consistent to its own digits only
Assembled<Mpfr> assembled_for_proof(const Scene& scene);
/// A time, likewise.
RealBall time_for_proof(const Expression& time, const Constants& constants);

/// The states of a proof at the times of a reference, in the digits of the scope in which it was made.
struct ProvedStates {
  explicit ProvedStates(const Scene& of);

  void add(const ProvedState& state);
  /// By how many digits a radius is greater than a hundredth of a unit of the last digit; at most 0 if none is. It is
  /// the most of all vectors and times. What vanishes is measured by what it is at other times, and H by its
  /// terms.
  double missing_digits(int digits) const;
  /// Fills in the states of a reference. \param agreement of `run` alone
  void write(Reference& reference, const ReferenceRequest& request, const Agreement& agreement) const;

  Assembled<Mpfr> scene;
  std::vector<ProvedState> states;
  NamedRun run{"proof", {}};  ///< the centres
};

}  // namespace hbvm::core

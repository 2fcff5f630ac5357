#pragma once

#include <functional>

#include "claim_group.hpp"

namespace hbvm::core {

/// Asked after every rung whether finer ones are not needed.
using Enough = std::function<bool(const Ladders&)>;

/// The errors of one step, of every quantity, until it is enough. Steps are 2^-2, 2^-3, …, 2^-12 of the time scale, and
/// then every fourth power down to 2^-128. Steps that cannot be made are left out; if none of the coarse ones can be
/// made, nothing is. \throws InputError, IntegrationError
template <Scalar S>
Ladders step_ladder(const ClaimGroup& group, const Enough& enough);

/// The errors over the group's windows in 4, 8, …, `most` steps a window, of what is asked for, until it is enough.
/// \throws InputError, IntegrationError
template <Scalar S>
Ladders interval_ladder(const ClaimGroup& group, long most, const Enough& enough);

/// So many steps of 2^log2_step of the time scale.
struct ConservationRun {
  int log2_step;
  long steps;
};
/// How many units of round-off each coordinate may be off by in every step. It is four times as many as numbers are
/// summed for it (k + s for HBVM).
double allowed_units(const Claim& claim);
/// The greatest error of an exactly conserved quantity in such a run, over what round-off may make of it. That of
/// Quantity::reversal is what the start is missed by after as many steps back.
struct RoundOff {
  double ratio = 0;
  Rung rung;  ///< the step; log2 of the error and of what is allowed
};
/// \throws StageFailure, InputError, IntegrationError
template <Scalar S>
std::map<Quantity, RoundOff> round_off(const ClaimGroup& group, const ConservationRun& run);

/// How far the coefficients of HBVM(k, s) are from the conditions they must meet, as log2.
template <Scalar S>
std::map<Quantity, double> tableau_defects(const Claim& subject);

/// Of hidden_constant, hidden_drift or sweeps; of a tableau its order, or the greatest q for which it fulfils C(q).
double special_value(const ClaimGroup& group);

}  // namespace hbvm::core

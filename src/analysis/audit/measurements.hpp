#pragma once

#include <functional>

#include "cell.hpp"
#include "laboratory.hpp"

namespace hbvm {

/// Asked after every rung whether finer ones are not needed.
using Enough = std::function<bool(const Ladders&)>;

/// The errors of one step, of every quantity, at h = 2^-2, 2^-3, …, 2^-12 and then every fourth power down to 2^-128,
/// until it is enough. Steps that cannot be made are left out; if none of the coarse ones can be made, nothing is.
/// \throws InputError, IntegrationError
template <Scalar S>
Ladders step_ladder(const Cell& cell, const Enough& enough);

/// The errors over the interval in 4, 8, …, `most` steps, of what is asked for, until it is enough.
/// \throws InputError, IntegrationError
template <Scalar S>
Ladders interval_ladder(const Cell& cell, long most, const Enough& enough);

/// What an exactly conserved quantity was off by over 16 steps of 1/16, in units of round-off; of Quantity::reversal,
/// what the start was missed by after as many steps back.
struct RoundOff {
  double units = 0;
  Rung rung;  ///< the step; log2 of the error and of one unit
};
template <Scalar S>
std::map<Quantity, RoundOff> round_off(const Cell& cell);

/// How far the coefficients of the method are from the conditions they must meet, in units of epsilon.
template <Scalar S>
std::map<Quantity, double> tableau_defects(const Claim& subject);

/// Of hidden_constant, hidden_drift or sweeps; of a tableau its order, or the greatest q for which it fulfils C(q).
double special_value(const Claim& claim);

/// Which conditions keep a tableau from having more than this order, and by how much they are missed.
std::string order_flaw(const Tableau& tableau, int order);

#define HBVM_DECLARE(S)                                                         \
  extern template Ladders step_ladder<S>(const Cell&, const Enough&);           \
  extern template Ladders interval_ladder<S>(const Cell&, long, const Enough&); \
  extern template std::map<Quantity, RoundOff> round_off<S>(const Cell&);       \
  extern template std::map<Quantity, double> tableau_defects<S>(const Claim& subject);
HBVM_FOR_EACH_SCALAR(HBVM_DECLARE)
#undef HBVM_DECLARE

}  // namespace hbvm

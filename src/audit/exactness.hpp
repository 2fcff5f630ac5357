#pragma once

#include <string>

#include "coefficients.hpp"

namespace hbvm::core {

/// Why a method must conserve what it is claimed to, but for round-off, whatever the motion: empty if nothing here
/// proves it. With k nodes and a potential of degree mu,
///
///     H, and H less the work: mu s <= 2k, Theorem 8; of a tableau mu <= 2 if it is symplectic, mu <= 1 from order 2 on
///     angular momentum: k = s, or mu <= 2, where the further nodes change nothing; of a tableau if it is symplectic
///     g, of degree 2: always;  there and back: always; of a tableau if it is symmetric
///
/// Of other methods, what they keep by construction.
/// \param check of the coefficients of HBVM or a tableau, on which all this rests, or null \throws InputError
std::string proof_of(const Claim& claim, const CoefficientCheck* check);

/// In how many decimal digits an error of the method that is not 0 would be seen at half the time scale. An error of
/// one step is of an order Q that k, s and r bound. Q is 2k + 1 for H and H - W, 2 max(r, s) + 1 for g of HBVM, 2s + 2
/// else. Gauss formulas of Q nodes gain at most some 3 + log2 Q bits of each where a step resolves the motion. What is
/// not integrated exactly, of any effect or within one formula, may be weaker than the rest: see WeakTerms.
///
/// \param log2_scale of the motion's time scale \throws InputError
int digits_to_show(const Claim& claim, int log2_scale);

}  // namespace hbvm::core

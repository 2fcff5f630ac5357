#pragma once

#include <string>
#include <vector>

#include "audit/claim.hpp"
#include "method/runge_kutta.hpp"

namespace hbvm::core {

enum class Extent {
  quick,  ///< s = 1, 2, 3 and the smaller problems: about a minute
  full    ///< s = 1 .. 8, all problems, and s = 12 and 20 with 200 digits
};

/// The paper's statements and those that are known beyond it. Each has the label of the theorem, corollary or remark it
/// belongs to. An error bound "O(h^r)" is claimed "at least". The form "exactly" is claimed only where the leading term
/// is known not to vanish.
std::vector<Claim> paper_claims(Extent extent);

/// Claims about HBVM(k, s) with r nodes for constraints that are not quadratic: the same orders of all components, and
/// symmetry. H has order 2k. g has order 2r, or round-off where it is a polynomial of degree d and r >= d s/2. Angular
/// momentum is kept for k = r = s. s = 1 .. 6, and 8 with 200 digits, for Extent::full; s = 1 and 2 else.
std::vector<Claim> general_claims(Extent extent);

/// Claims about HBVM(k, s) with r nodes for constraints where forces do work, points move or t stands in a scene. q,
/// the tangential p and the output multiplier have order 2s. H - W has order 2k, or is kept to round-off where U is a
/// polynomial that the nodes integrate. g has order 2r where a point moves. A force that does no work leaves H at
/// round-off. Steps of -h lead back. s = 1 .. 6 for Extent::full; s = 1 and 2 else.
std::vector<Claim> work_claims(Extent extent);

/// Claims about states at times that are no mesh points: q, p and lambda have order 2s at five points within a step.
/// s = 1 .. 6 for Extent::full; s = 1 and 2 else.
std::vector<Claim> between_claims(Extent extent);

/// What a Runge-Kutta method must show on the problems without constraints: its order, and that of the energy error.
/// The order is what its author states; if none, what its conditions show to ten digits, as a look in double would have
/// it. Symmetry and conservation of angular momentum are claimed if the coefficients say so to ten digits.
std::vector<Claim> tableau_claims(const Tableau& tableau);

/// What a method of the registry says of itself, on scenes with constraints and without. These are the orders of its
/// components, what it keeps to round-off, and at which order it loses the rest. \throws InputError for hbvm:auto,S
std::vector<Claim> method_claims(const MethodPtr& method);

/// Claims written in TOML, an array of tables [[claim]] with
///
///     quantity = "raw p"          what name_of gives: "q", "H", "g", "hidden" …
///     problem = "double_pendulum" a scene, by name or file
///     method = "hbvm:3,2"         what parse_method reads, or a file with a tableau
///     rate = "2*s"                an expression of the method's k and s; or "round-off"
///     form = "exactly"            "at least" if absent
///     over = "step"               "interval" if absent
///     degenerate = true           if it speaks of a motion that says nothing of the method, a relative equilibrium
///     perturb = { part = "node", i = 1, j = 1, hat = false, relative = "1e-25" }
///                                 optional: node, weight, integral, X or legendre, counted from 1
///
/// Files are looked for beside the claims' file first.
/// \throws InputError with file, line and what is wrong
std::vector<Claim> read_claims(const std::string& path);

}  // namespace hbvm::core

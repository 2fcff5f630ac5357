#pragma once

#include <string>
#include <vector>

#include "scalar/precision.hpp"
#include "step/method.hpp"

namespace hbvm::core {

/// How near to one another the members of a family are.
enum class Choice {
  plain,  ///< for curves
  dense   ///< for the best
};

/// Methods by what a user lists: a method as parse_method() reads it, or the name of a family. A family stands for
/// members of it that suit so many digits. The names are "gauss" (HBVM(s,s)), "auto" (hbvm:auto,S), "rattle",
/// "compose", "lobatto", "projected_hbvm", "restored_hbvm", "bulirsch_stoer", and any other family of the registry that
/// needs no arguments. An empty list is all of these.
/// \throws InputError for what is neither
std::vector<MethodPtr> cost_methods(const std::vector<std::string>& list, double most_digits,
                                    Choice choice = Choice::plain);

/// The names of families that the list may hold.
std::vector<std::string> cost_families();

/// Whether a method that divides its steps asks for no more digits in them than a precision has, nor far fewer. One
/// that keeps the energy whatever the step asks for as many as there are.
bool suits(const Method& method, const Precision& precision);

/// About what length of step, of the radius of convergence, errors of a method of this order pass 1. These are
/// hypotheses for choosing steps, which measurements replace.
double typical_reach(const Method& method);

}  // namespace hbvm::core

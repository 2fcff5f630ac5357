#pragma once

#include <string>
#include <vector>

#include "hbvm/step/method.hpp"

namespace hbvm {

/// How near to one another the members of a family are.
enum class Choice {
  plain,  ///< for curves
  dense   ///< for the best
};

/// Methods by what a user lists: a method as parse_method() reads it, or the name of a family, which stands for members
/// of it that suit so many digits: "gauss" (HBVM(s,s)), "auto" (hbvm:auto,S), "rattle", "compose", "lobatto", and any
/// other family of the registry that needs no arguments. An empty list is all of these.
/// \throws InputError for what is neither
std::vector<MethodPtr> cost_methods(const std::vector<std::string>& list, double most_digits,
                                    Choice choice = Choice::plain);

/// The names of families that the list may hold.
std::vector<std::string> cost_families();

/// About what length of step, of the radius of convergence, errors of a method of this order pass 1: hypotheses for
/// choosing steps, which measurements replace.
double typical_reach(const Method& method);

}  // namespace hbvm

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hbvm/number.hpp"

namespace hbvm {

/// A kind of method by its name before the colon, and how it is written: "hbvm", "hbvm:K,S".
struct MethodKind {
  std::string name, usage;
};
/// All there are.
std::vector<MethodKind> methods();

/// What is known of one method.
struct MethodFacts {
  std::string text, title;  ///< "hbvm:4,2", "HBVM(4,2)"
  int order = 0;            ///< of q and of the tangential momentum over an interval; 0 if it is not known
  int stages = 0;           ///< s
  bool keeps_energy = false, keeps_momenta = false, keeps_constraints = false, is_symmetric = false;
};
/// \throws InputError for a method that does not exist, with what there is
MethodFacts method_facts(const std::string& method);

/// A Runge-Kutta method as its author writes it: s x s, s and s exact numbers.
struct Tableau {
  std::string name;
  NumberRows A = {};
  Numbers b = {}, c = {};          ///< c are the row sums of A if it is empty
  std::optional<int> order = {};   ///< that its author claims
  std::optional<int> digits = {};  ///< to which its author gives the numbers that are decimals
};

/// From a TOML file. \throws InputError with file, line and what is wrong
Tableau read_tableau(const std::string& path);

}  // namespace hbvm

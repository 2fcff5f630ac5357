#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hbvm/number.hpp"

namespace hbvm {

/// What runs where no method is asked for: energy and constraints to round-off, at order 6.
inline constexpr const char* usual_method = "hbvm:auto,3";

/// A kind of method, or another name of one.
struct MethodKind {
  std::string name;   ///< before the colon: "hbvm"
  std::string form;   ///< how it is written: "hbvm:K,S"
  std::string meant;  ///< "rattle", if this is another name of it; what follows, but the note, is then empty
  std::string order;  ///< "2S"
  std::string keeps;  ///< what every motion keeps but for round-off, of "energy, momenta, constraints, reversal"
  std::string work;   ///< what a step costs
  std::string note;
};
/// All there are.
std::vector<MethodKind> methods();
std::string to_text(const std::vector<MethodKind>& kinds);
std::string to_json(const std::vector<MethodKind>& kinds);

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

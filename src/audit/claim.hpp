#pragma once

#include <string>

#include "audit/quantity.hpp"
#include "step/method.hpp"

namespace hbvm::core {

/// How the error of a method is looked at.
enum class Span {
  step,     ///< after one step from consistent states
  interval  ///< after all steps to a fixed time, or the greatest over them (g, hidden, H, angular momentum)
};

enum class Form {
  at_least,   ///< the error is O(h^rate)
  exactly,    ///< and no smaller
  round_off,  ///< the error is 0 but for round-off, in every precision
  near,       ///< the quantity itself lies within a tolerance of a value
  digits      ///< the error is below 10^-predicted at any step: of a method with a tolerance
};

/// One statement about one method and problem.
struct Claim {
  std::string label;  ///< of the paper's statement, or where else it is from
  Quantity quantity = Quantity::q;
  std::string problem;  ///< a scene, by name or file; "tableau" for the coefficients alone
  MethodPtr method;
  Span span = Span::interval;
  Form form = Form::at_least;
  double predicted = 0;               ///< rate, or value
  double tolerance = 0;               ///< of Form::near
  unsigned least_digits = 0;          ///< with which it must be looked at
  bool of_degenerate_motion = false;  ///< it speaks of the very motion, though that says nothing of the method

  /// "HBVM(3,2)", or the tableau's name.
  std::string method_text() const { return method->title(); }
};

/// A claim whose method is still to be said.
Claim make_claim(const std::string& label, Quantity quantity, const std::string& problem, Span span, Form form,
                 double predicted);

/// A label for readers of the printed paper: "Theorem 5 (ord2s), one step" for "ord2s, one step". Labels of no
/// statement there are left as they are.
std::string readable(const std::string& label);

}  // namespace hbvm::core

#include <algorithm>

#include "audit/claims.hpp"
#include "method/decimals.hpp"
#include "method/order_conditions.hpp"
#include "method/symmetry_defect.hpp"
#include "step/tableau_method.hpp"

namespace hbvm::core {

std::vector<Claim> tableau_claims(const Tableau& tableau) {
  const auto method = std::make_shared<const TableauMethod>(tableau, tableau.name);
  const PrecisionScope scope(100);
  const RungeKutta<Mpfr> coefficients = make_runge_kutta<Mpfr>(tableau);
  // Of decimals with fewer digits those that four roundings leave.
  const std::optional<Decimals> decimals = decimals_of(tableau);
  const Mpfr ten_digits = pow(Mpfr(10), -(decimals ? std::clamp(decimals->digits - 4, 1, 10) : 10));
  const int nominal = tableau.order ? *tableau.order : order(coefficients, ten_digits);
  std::vector<Claim> claims;
  const auto add = [&](const std::string& label, Quantity quantity, const std::string& problem, Form form,
                       double predicted) {
    claims.push_back(make_claim(label, quantity, problem, Span::interval, form, predicted));
    claims.back().method = method;
  };
  const std::string stated = tableau.order ? "stated order" : "order to ten digits";
  add(stated, Quantity::order_conditions, "tableau", Form::at_least, nominal);
  add("row sums", Quantity::C, "tableau", Form::at_least, 1);
  for (const char* const problem : {"kepler", "quartic_oscillator"}) {
    for (const Quantity quantity : {Quantity::q, Quantity::p, Quantity::H})
      add(stated, quantity, problem, Form::at_least, nominal);
    if (symmetry_defect(coefficients) <= ten_digits) add("symmetry", Quantity::reversal, problem, Form::round_off, 0);
    if (symplecticity_defect(coefficients) <= ten_digits)
      add("symplecticity", Quantity::angular_momentum, problem, Form::round_off, 0);
  }
  return claims;
}

}  // namespace hbvm::core

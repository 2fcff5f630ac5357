#pragma once

#include <optional>
#include <string_view>

#include "hbvm/error.hpp"
#include "method/hbvm.hpp"
#include "method/known_tableaux.hpp"
#include "method/order_conditions.hpp"
#include "printing.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {

inline Tableau tableau(const NumberRows& A, const Numbers& b, const Numbers& c, std::optional<int> order = {}) {
  return {"test", A, b, c, order};
}

/// A known one, of no stated order.
inline Tableau known(std::string_view name) {
  for (const KnownTableau& one : known_tableaux())
    if (one.name == name) return tableau(one.tableau.A, one.tableau.b, one.tableau.c);
  throw InputError("no known tableau");
}

inline Tableau rk4() { return known("rk4"); }
/// Large coefficients of both signs.
inline Tableau dopri5() { return known("dopri5"); }
inline Tableau radau_iia() { return tableau({{"5/12", "-1/12"}, {"3/4", "1/4"}}, {"3/4", "1/4"}, {"1/3", "1"}); }

template <Scalar S>
RungeKutta<S> gauss(int s) {
  const Hbvm<S> method = make_hbvm<S>(s, s);
  return {method.A, method.b, method.c};
}

template <class S>
class TableauTest : public InDigits<50> {
 protected:
  const S tolerance = 1'000 * epsilon<S>();

  int order_of(const Tableau& tableau) const { return order(make_runge_kutta<S>(tableau), tolerance); }
  void expect_zero(const S& defect, const char* what, int s) const { EXPECT_LE(defect, tolerance) << what << " " << s; }
  void expect_nonzero(const S& defect, const char* what) const { EXPECT_GE(defect, literal<S>("1e-3")) << what; }
};

}  // namespace hbvm::core

#pragma once

#include <optional>

#include "method/hbvm.hpp"
#include "method/order_conditions.hpp"
#include "printing.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {

inline Tableau tableau(const NumberRows& A, const Numbers& b, const Numbers& c, std::optional<int> order = {}) {
  return {"test", A, b, c, order};
}

inline Tableau rk4() {
  return tableau({{"0", "0", "0", "0"}, {"1/2", "0", "0", "0"}, {"0", "0.5", "0", "0"}, {"0", "0", "1", "0"}},
                 {"1/6", "1/3", "1/3", "1/6"}, {"0", "1/2", "1/2", "1"});
}
inline Tableau radau_iia() { return tableau({{"5/12", "-1/12"}, {"3/4", "1/4"}}, {"3/4", "1/4"}, {"1/3", "1"}); }

/// Dormand and Prince, order 5: large coefficients of both signs.
inline Tableau dopri5() {
  return tableau({{"0", "0", "0", "0", "0", "0"},
                  {"1/5", "0", "0", "0", "0", "0"},
                  {"3/40", "9/40", "0", "0", "0", "0"},
                  {"44/45", "-56/15", "32/9", "0", "0", "0"},
                  {"19372/6561", "-25360/2187", "64448/6561", "-212/729", "0", "0"},
                  {"9017/3168", "-355/33", "46732/5247", "49/176", "-5103/18656", "0"}},
                 {"35/384", "0", "500/1113", "125/192", "-2187/6784", "11/84"},
                 {"0", "1/5", "3/10", "4/5", "8/9", "1"});
}

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

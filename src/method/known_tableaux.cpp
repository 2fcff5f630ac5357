#include "method/known_tableaux.hpp"

namespace hbvm::core {
namespace {

// Hairer, Norsett, Wanner: Solving Ordinary Differential Equations I, section II.1 (Heun, Runge-Kutta).
Tableau euler() { return {"Euler", {{"0"}}, {"1"}, {"0"}, 1}; }

Tableau heun() { return {"Heun", {{"0", "0"}, {"1", "0"}}, {"1/2", "1/2"}, {"0", "1"}, 2}; }

Tableau rk4() {
  return {"RK4",
          {{"0", "0", "0", "0"}, {"1/2", "0", "0", "0"}, {"0", "1/2", "0", "0"}, {"0", "0", "1", "0"}},
          {"1/6", "1/3", "1/3", "1/6"},
          {"0", "1/2", "1/2", "1"},
          4};
}

// Dormand, Prince: J. Comput. Appl. Math. 6 (1980) 19-26. The seventh stage serves the estimate of the error alone.
Tableau dopri5() {
  return {"Dormand-Prince 5",
          {{"0", "0", "0", "0", "0", "0"},
           {"1/5", "0", "0", "0", "0", "0"},
           {"3/40", "9/40", "0", "0", "0", "0"},
           {"44/45", "-56/15", "32/9", "0", "0", "0"},
           {"19372/6561", "-25360/2187", "64448/6561", "-212/729", "0", "0"},
           {"9017/3168", "-355/33", "46732/5247", "49/176", "-5103/18656", "0"}},
          {"35/384", "0", "500/1113", "125/192", "-2187/6784", "11/84"},
          {"0", "1/5", "3/10", "4/5", "8/9", "1"},
          5};
}

// Alexander: SIAM J. Numer. Anal. 14 (1977) 1006-1021, L-stable, of two and three stages.
Tableau sdirk2() {
  const char* const gamma = "1-sqrt(2)/2";
  const char* const rest = "sqrt(2)/2";
  return {"SDIRK(2)", {{gamma, "0"}, {rest, gamma}}, {rest, gamma}, {gamma, "1"}, 2};
}

Tableau sdirk3() {
  // The middle root of x^3 - 3 x^2 + 3/2 x - 1/6 = 0, by the cosine of a third of an angle.
  const std::string gamma = "(1+sqrt(2)*cos((atan(sqrt(2)/4)-2*pi)/3))";
  const Number first("-(6*" + gamma + "^2-16*" + gamma + "+1)/4"), second("(6*" + gamma + "^2-20*" + gamma + "+5)/4");
  return {"SDIRK(3)",
          {{gamma, "0", "0"}, {Number("(1-" + gamma + ")/2"), gamma, "0"}, {first, second, gamma}},
          {first, second, gamma},
          {gamma, Number("(1+" + gamma + ")/2"), "1"},
          3};
}

// Hairer, Wanner: Solving Ordinary Differential Equations II, table 6.5 of section IV.6.
Tableau sdirk5() {
  return {"SDIRK(5)",
          {{"1/4", "0", "0", "0", "0"},
           {"1/2", "1/4", "0", "0", "0"},
           {"17/50", "-1/25", "1/4", "0", "0"},
           {"371/1360", "-137/2720", "15/544", "1/4", "0"},
           {"25/24", "-49/48", "125/16", "-85/12", "1/4"}},
          {"25/24", "-49/48", "125/16", "-85/12", "1/4"},
          {"1/4", "3/4", "11/20", "1/2", "1"},
          4};
}

}  // namespace

const std::vector<KnownTableau>& known_tableaux() {
  static const std::vector<KnownTableau> all{{"euler", euler()},   {"heun", heun()},      {"rk4", rk4()},
                                             {"dopri5", dopri5()}, {"sdirk:2", sdirk2()}, {"sdirk:3", sdirk3()},
                                             {"sdirk:5", sdirk5()}};
  return all;
}

}  // namespace hbvm::core

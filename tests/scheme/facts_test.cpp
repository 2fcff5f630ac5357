#include "scheme/facts.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "scheme/tables.hpp"

namespace hbvm::core {
namespace {

std::vector<std::string> facts(const std::string& text) {
  const SchemePtr scheme = scheme_of(text);
  const Rounding rounding = Rounding::of(*scheme, {});
  const PrecisionScope scope(rounding.working_digits);
  const std::vector<Mpfr> values = scheme->written_values<Mpfr>();
  return facts_of(*scheme, values, rounding, met_parts(*scheme, values, rounding).front().order);
}

void expect_facts(const std::string& text, const std::vector<std::string>& expected) {
  const std::vector<std::string> found = facts(text);
  for (const std::string& fact : expected)
    EXPECT_NE(std::find(found.begin(), found.end(), fact), found.end()) << fact << "\n" << text;
}

TEST(SchemeFacts, OfRungeKuttaMethods) {
  // The real interval of order 4 ends where 1 + z + z^2/2 + z^3/6 + z^4/24 is 1 again, the imaginary one at 2 sqrt(2).
  expect_facts(
      "A = [[0,0,0,0],['1/2',0,0,0],[0,'1/2',0,0],[0,0,1,0]]\nb = ['1/6','1/3','1/3','1/6']\n",
      {"explicit", "not symplectic", "not symmetric",
       "stability interval 2.79 on the negative real axis, 2.83 on the imaginary axis", "error constant 0.0145"});
  expect_facts("A = [['1/4','1/4-sqrt(3)/6'],['1/4+sqrt(3)/6','1/4']]\nb = ['1/2','1/2']\n",
               {"implicit", "symplectic", "symmetric", "R(inf) = 1", "A-stable", "algebraically stable"});
  expect_facts("A = [['5/12','-1/12'],['3/4','1/4']]\nb = ['3/4','1/4']\n",
               {"implicit", "stiffly accurate", "not symplectic", "R(inf) = 0", "L-stable", "algebraically stable"});
  expect_facts("A = [['1-sqrt(2)/2',0],['sqrt(2)/2','1-sqrt(2)/2']]\nb = ['sqrt(2)/2','1-sqrt(2)/2']\n",
               {"diagonally implicit", "stiffly accurate", "R(inf) = 0"});
  expect_facts("A = [[0,0,0,0],['1/2',0,0,0],[0,'3/4',0,0],['2/9','1/3','4/9',0]]\nb = ['2/9','1/3','4/9',0]\n",
               {"first same as last"});
}

TEST(SchemeFacts, OfDecimalsAreSeenToTheirDigits) {
  expect_facts("A = [['0.25','-0.03867513459481288'],['0.53867513459481288','0.25']]\nb = ['0.5','0.5']\n",
               {"symplectic", "symmetric"});
  expect_facts("A = [['0.25','-0.03867513459481287'],['0.53867513459481288','0.25']]\nb = ['0.5','0.5']\n",
               {"symplectic to 17 digits"});
}

TEST(SchemeFacts, OfOtherFamilies) {
  expect_facts("alpha = ['1/3','-4/3',1]\nbeta = [0,0,'2/3']\n",
               {"implicit", "zero-stable", "error constant -3.333e-01"});
  expect_facts("alpha = [-5,4,1]\nbeta = [2,4,0]\n", {"explicit", "not zero-stable"});
  expect_facts(forest_ruth, {"symmetric"});
  expect_facts("a = [1]\nb = [1]\n", {"not symmetric"});
  expect_facts("gamma = ['1/2','1/3','1/6']\n", {"not symmetric"});
}

}  // namespace
}  // namespace hbvm::core

#include "audit/weak_terms.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/assemble.hpp"

namespace hbvm::core {
namespace {

WeakTerms terms_of(const std::string& U, int exact_degree, const std::string& constraint = "") {
  return {
      assemble<Mpfr>(read_scene("dimension = 2\nbody = [{ name = \"a\", mass = 1, position = [1, 0], velocity = [0, "
                                "1] }]\n[[effect]]\nkind = \"formula\"\nU = \"" +
                                    U + "\"\n" + constraint,
                                "weak")),
      0, exact_degree};
}

/// A term of degree 4 that is weaker by 10^-150 within one formula. Its size is found by the recorded program, in
/// digits that hold it.
TEST(WeakTerms, AreFoundWithinAFormula) {
  const PrecisionScope scope(digits_of_terms);
  const double bits = 150 * std::log2(10.0);
  for (const char* U : {"-x^2/2 - y^2 - 1e-150*x^4", "-(x^2 + y^2)/2 - 1e-150*(x^2 + y^2)^2"}) {
    const WeakTerms terms = terms_of(U, 2);
    EXPECT_GT(terms.of_U().told, bits - 40) << U;
    EXPECT_LT(terms.of_U().told, bits + 200) << U;
  }
  EXPECT_EQ(terms_of("-x^2/2 - y^2", 2).of_U().all, 0);
  EXPECT_LT(terms_of("-x^4/4 - y^4", 2).of_U().all, 60) << "as strong as the rest";
}

/// Within a product and a power the weak factor is far stronger than the term that it makes.
TEST(WeakTerms, AreFoundWithinProducts) {
  const PrecisionScope scope(digits_of_terms);
  for (const auto& [U, power] : {std::pair("-x^2/2*(1 + 1e-120*x^2) - y^2", 120.0),
                                 {"-x^2/2 - y^2 - x*(1 + 1e-75*x)^2", 150.0},
                                 {"-x^2/2 - y^2 - 1e-900*x^4", 900.0}}) {
    const double bits = power * std::log2(10.0);
    EXPECT_GT(terms_of(U, 2).of_U().told, bits - 40) << U;
    EXPECT_LT(terms_of(U, 2).of_U().told, bits + 200) << U;
  }
}

/// A term that is weaker than the digits show is there in any digits, what cancels is less with every digit.
TEST(WeakTerms, AreToldFromRounding) {
  const auto all = [](const char* U, unsigned digits) {
    const PrecisionScope scope(digits);
    return terms_of(U, 2).of_U().all;
  };
  const char* const weak = "-x^2/2 - y^2 - 1e-150*x^4";
  EXPECT_NEAR(all(weak, 60), all(weak, 100), 10);
  const char* const cancelled = "-x^2/2 - y^2 - (x + 1/3)^4 + x^4 + 4/3*x^3";
  EXPECT_GT(all(cancelled, 100), all(cancelled, 60) + 50);
  const PrecisionScope scope(60);
  EXPECT_EQ(terms_of(cancelled, 2).of_U().told, 0);
}

TEST(WeakTerms, OfConstraintsStandAlone) {
  const PrecisionScope scope(digits_of_terms);
  const WeakTerms terms =
      terms_of("-y", 2, "[[constraint]]\nkind = \"formula\"\non = \"a\"\ng = \"x^2 + y^2 - 1 + 1e-150*y^8\"\n");
  EXPECT_GT(terms.of_g().told, 150 * std::log2(10.0) - 40);
}

}  // namespace
}  // namespace hbvm::core

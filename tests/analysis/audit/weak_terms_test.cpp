#include "analysis/audit/weak_terms.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hbvm/scene/assemble.hpp"

namespace hbvm {
namespace {

WeakTerms terms_of(const std::string& U, int exact_degree, const std::string& constraint = "") {
  return {
      assemble<Mpfr>(read_scene("dimension = 2\nbody = [{ name = \"a\", mass = 1, position = [1, 0], velocity = [0, "
                                "1] }]\n[[effect]]\nkind = \"formula\"\nU = \"" +
                                    U + "\"\n" + constraint,
                                "weak")),
      0, exact_degree};
}

/// A term of degree 4 that is weaker by 10^-150 within one formula: its size is found by the recorded program, in
/// digits that hold it.
TEST(WeakTerms, AreFoundWithinAFormula) {
  const PrecisionScope scope(digits_of_terms);
  const double bits = 150 * std::log2(10.0);
  for (const char* U : {"-x^2/2 - y^2 - 1e-150*x^4", "-(x^2 + y^2)/2 - 1e-150*(x^2 + y^2)^2"}) {
    const WeakTerms terms = terms_of(U, 2);
    EXPECT_GT(terms.bits_of_U(), bits - 40) << U;
    EXPECT_LT(terms.bits_of_U(), bits + 200) << U;
  }
  EXPECT_EQ(terms_of("-x^2/2 - y^2", 2).bits_of_U(), 0);
  EXPECT_LT(terms_of("-x^4/4 - y^4", 2).bits_of_U(), 60) << "as strong as the rest";
}

TEST(WeakTerms, AreSaidToHideInFewDigits) {
  const PrecisionScope scope(60);
  EXPECT_TRUE(terms_of("-x^2/2 - y^2 - 1e-150*x^4", 2).may_hide());
  EXPECT_FALSE(terms_of("-x^2/2 - y^2 - x^4", 2).may_hide());
}

TEST(WeakTerms, OfConstraintsStandAlone) {
  const PrecisionScope scope(digits_of_terms);
  const WeakTerms terms =
      terms_of("-y", 2, "[[constraint]]\nkind = \"formula\"\non = \"a\"\ng = \"x^2 + y^2 - 1 + 1e-150*y^8\"\n");
  EXPECT_GT(terms.bits_of_g(), 150 * std::log2(10.0) - 40);
}

}  // namespace
}  // namespace hbvm

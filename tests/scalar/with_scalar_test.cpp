#include "scalar/with_scalar.hpp"

#include <stdexcept>

#include "printing.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

std::string chosen(const char* precision) {
  return with_scalar(Precision::parse(precision), []<Scalar S>() {
    return ScalarNames::GetName<S>(0) + " with " + std::to_string(digits10<S>()) + " digits";
  });
}

TEST(WithScalar, ChoosesTypeAndDigits) {
  EXPECT_EQ(chosen("double"), "double with 15 digits");
  EXPECT_EQ(chosen("quad"), "Quad with 33 digits");
  EXPECT_EQ(chosen("mpfr:20"), "Mpfr with 20 digits");
  EXPECT_EQ(chosen("mpfr:1234"), "Mpfr with 1234 digits");
}

TEST(WithScalar, RestoresTheDigits) {
  const PrecisionScope scope(44);
  chosen("mpfr:99");
  EXPECT_EQ(Mpfr::thread_default_precision(), 44u);
  EXPECT_THROW(with_scalar(Precision::parse("mpfr:99"), []<Scalar S>() -> int { throw std::runtime_error("out"); }),
               std::runtime_error);
  EXPECT_EQ(Mpfr::thread_default_precision(), 44u);
}

TEST(WithScalar, ReturnsNothingToo) {
  int digits = 0;
  with_scalar(Precision::parse("mpfr:60"), [&]<Scalar S>() { digits = digits10<S>(); });
  EXPECT_EQ(digits, 60);
}

TEST(WithScalar, ResultHasAllDigits) {
  const std::string pi = with_scalar(Precision::parse("mpfr:50"), []<Scalar S>() { return to_text(literal<S>("pi")); });
  EXPECT_TRUE(pi.starts_with("3.1415926535897932384626433832795028841971693993751")) << pi;
}

}  // namespace
}  // namespace hbvm::core

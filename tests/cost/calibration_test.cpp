#include "cost/calibration.hpp"

#include <gtest/gtest.h>

#include "scalar/with_scalar.hpp"

namespace hbvm::core {
namespace {

TEST(Calibration, MeasuresInEveryPrecision) {
  for (const char* const name : {"double", "quad", "mpfr:20", "mpfr:100", "mpfr:1000"}) {
    const Precision precision = Precision::parse(name);
    with_scalar(precision, [&]<Scalar S>() { EXPECT_GT(Calibration<S>(precision).seconds(), 0) << name; });
  }
}

TEST(Calibration, KnowsThatDigitsCost) {
  double before = 0;
  for (const char* const name : {"double", "mpfr:20", "mpfr:50", "mpfr:200", "mpfr:2000"}) {
    const double now = typical_nanoseconds(Precision::parse(name));
    EXPECT_GT(now, before) << name;
    before = now;
  }
}

}  // namespace
}  // namespace hbvm::core

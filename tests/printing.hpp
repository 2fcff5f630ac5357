#pragma once

#include <gtest/gtest.h>

#include <ostream>

#include "scalar/mpfr.hpp"
#include "scalar/text.hpp"

namespace hbvm::core {

/// The scalars a typed suite runs for; tests of Mpfr open a PrecisionScope.
using AllScalars = ::testing::Types<double, Quad, Mpfr>;

struct ScalarNames {
  template <class S>
  static std::string GetName(int) {
    return std::same_as<S, double> ? "double" : std::same_as<S, Quad> ? "Quad" : "Mpfr";
  }
};

/// A test with so many digits in Mpfr.
template <int decimals>
class InDigits : public ::testing::Test {
 protected:
  PrecisionScope digits{decimals};
};

}  // namespace hbvm::core

// GoogleTest would print six digits.
namespace boost::multiprecision {
inline void PrintTo(const hbvm::core::Quad& x, std::ostream* out) { *out << hbvm::core::to_text(x); }
inline void PrintTo(const hbvm::core::Mpfr& x, std::ostream* out) { *out << hbvm::core::to_text(x); }
}  // namespace boost::multiprecision

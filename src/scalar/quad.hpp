#pragma once

#include "scalar/mpfr.hpp"

/// A build without Quad (CMake's HBVM_QUAD=OFF) defines this as 0.
#ifndef HBVM_QUAD
#define HBVM_QUAD 1
#endif

namespace hbvm {

inline constexpr bool has_quad = HBVM_QUAD != 0;

}  // namespace hbvm

#if HBVM_QUAD

#include <boost/multiprecision/float128.hpp>

namespace hbvm {

/// IEEE binary128 (113 significand bits, about 34 digits), computed in software by libquadmath.
using Quad = boost::multiprecision::number<boost::multiprecision::float128_backend, boost::multiprecision::et_off>;

}  // namespace hbvm

namespace boost::multiprecision {
HBVM_FORBID_BINARY(hbvm::Quad, float)
HBVM_FORBID_BINARY(hbvm::Quad, double)
HBVM_FORBID_BINARY(hbvm::Quad, long double)
}  // namespace boost::multiprecision

#else

namespace hbvm {

/// Its name alone, for code that asks whether a scalar is this one.
class Quad;

}  // namespace hbvm

#endif

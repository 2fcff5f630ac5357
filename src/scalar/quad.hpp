#pragma once

#include "scalar/mpfr.hpp"

/// A build without Quad (CMake's HBVM_QUAD=OFF) defines this as 0.
#ifndef HBVM_QUAD
#define HBVM_QUAD 1
#endif

namespace hbvm::core {

inline constexpr bool has_quad = HBVM_QUAD != 0;

}  // namespace hbvm::core

#if HBVM_QUAD

#include <boost/multiprecision/float128.hpp>

namespace hbvm::core {

/// IEEE binary128 (113 significand bits, about 34 digits), computed in software by libquadmath.
using Quad = boost::multiprecision::number<boost::multiprecision::float128_backend, boost::multiprecision::et_off>;

}  // namespace hbvm::core

namespace boost::multiprecision {
HBVM_FORBID_BINARY(hbvm::core::Quad, float)
HBVM_FORBID_BINARY(hbvm::core::Quad, double)
HBVM_FORBID_BINARY(hbvm::core::Quad, long double)
}  // namespace boost::multiprecision

#else

namespace hbvm::core {

/// Its name alone, for code that asks whether a scalar is this one.
class Quad;

}  // namespace hbvm::core

#endif

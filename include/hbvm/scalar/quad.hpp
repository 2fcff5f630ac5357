#pragma once

#include <boost/multiprecision/float128.hpp>

#include "hbvm/scalar/mpfr.hpp"

namespace hbvm {

/// IEEE binary128 (113 significand bits, about 34 digits), computed in software by libquadmath.
using Quad = boost::multiprecision::number<boost::multiprecision::float128_backend, boost::multiprecision::et_off>;

}  // namespace hbvm

namespace boost::multiprecision {
HBVM_FORBID_BINARY(hbvm::Quad, float)
HBVM_FORBID_BINARY(hbvm::Quad, double)
HBVM_FORBID_BINARY(hbvm::Quad, long double)
}  // namespace boost::multiprecision

#pragma once

#include "scalar/binary128.hpp"
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

/// IEEE binary128 (113 significand bits, about 34 digits), computed in software: by binary128.hpp, and by libquadmath
/// what that leaves.
using Quad = boost::multiprecision::number<boost::multiprecision::float128_backend, boost::multiprecision::et_off>;

/// Its bits, and the number that has these.
inline binary128::Bits bits_of(const Quad& x) { return binary128::bits_of(x.backend().value()); }
inline void set_bits(Quad& x, const binary128::Bits& bits) { binary128::set_bits(x.backend().value(), bits); }

}  // namespace hbvm::core

// For operators and functions of Quad: that of binary128.hpp or, where it does not answer, that of the library. They
// must stand in Boost's namespace, where they are preferred to Boost's templates. Arithmetic takes numbers by value: to
// references, those templates would be preferred that take a number that is moved from.
#define HBVM_QUAD_OPERATOR(op, ours, ...)                                                                 \
  inline hbvm::core::Quad operator op(hbvm::core::Quad a, hbvm::core::Quad b) {                           \
    hbvm::core::binary128::Bits r;                                                                        \
    if (!ours(r, hbvm::core::bits_of(a), hbvm::core::bits_of(b) __VA_OPT__(, ) __VA_ARGS__)) [[unlikely]] \
      return hbvm::core::Quad(a.backend().value() op b.backend().value());                                \
    hbvm::core::set_bits(a, r);                                                                           \
    return a;                                                                                             \
  }
#define HBVM_QUAD_COMPARISON(op, ours) \
  inline bool operator op(const hbvm::core::Quad& a, const hbvm::core::Quad& b) { return ours; }
#define HBVM_QUAD_FUNCTION(name, ours, library)              \
  inline hbvm::core::Quad name(const hbvm::core::Quad& a) {  \
    hbvm::core::binary128::Bits r;                           \
    if (!ours(r, hbvm::core::bits_of(a))) [[unlikely]]       \
      return hbvm::core::Quad(library(a.backend().value())); \
    hbvm::core::Quad result;                                 \
    hbvm::core::set_bits(result, r);                         \
    return result;                                           \
  }

namespace boost::multiprecision {
HBVM_QUAD_OPERATOR(+, add)
HBVM_QUAD_OPERATOR(-, add, hbvm::core::binary128::Bits::sign)
HBVM_QUAD_OPERATOR(*, multiply)
HBVM_QUAD_COMPARISON(==, equal(hbvm::core::bits_of(a), hbvm::core::bits_of(b)))
HBVM_QUAD_COMPARISON(!=, !equal(hbvm::core::bits_of(a), hbvm::core::bits_of(b)))
HBVM_QUAD_COMPARISON(<, less(hbvm::core::bits_of(a), hbvm::core::bits_of(b)))
HBVM_QUAD_COMPARISON(>, less(hbvm::core::bits_of(b), hbvm::core::bits_of(a)))
HBVM_QUAD_FUNCTION(sqrt, square_root, sqrtq)
HBVM_QUAD_FUNCTION(sin, sine, sinq)
HBVM_QUAD_FUNCTION(cos, cosine, cosq)
inline hbvm::core::Quad abs(hbvm::core::Quad a) {
  hbvm::core::set_bits(a, hbvm::core::bits_of(a).magnitude());
  return a;
}
inline bool isfinite(const hbvm::core::Quad& a) { return hbvm::core::bits_of(a).finite(); }
inline hbvm::core::Quad ldexp(hbvm::core::Quad a, int exponent) {
  hbvm::core::binary128::Bits r;
  if (!scale(r, hbvm::core::bits_of(a), exponent)) return hbvm::core::Quad(ldexpq(a.backend().value(), exponent));
  hbvm::core::set_bits(a, r);
  return a;
}

HBVM_FORBID_BINARY(hbvm::core::Quad, float)
HBVM_FORBID_BINARY(hbvm::core::Quad, double)
HBVM_FORBID_BINARY(hbvm::core::Quad, long double)
}  // namespace boost::multiprecision
#undef HBVM_QUAD_OPERATOR
#undef HBVM_QUAD_COMPARISON
#undef HBVM_QUAD_FUNCTION

#else

namespace hbvm::core {

/// Its name alone, for code that asks whether a scalar is this one.
class Quad;

}  // namespace hbvm::core

#endif

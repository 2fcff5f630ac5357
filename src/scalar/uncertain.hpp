#pragma once

#include "scalar/scalar.hpp"

namespace hbvm::core {

/// A number known up to an error bound: the round-off of what it was computed from, which every operation passes on. So
/// a sum that would vanish but for that round-off is told from one that is small, whatever the sizes and units of
/// others. Values carry the digits of the PrecisionScope, which should be some more than those of what goes in.
struct Uncertain {
  Mpfr value = 0, error = 0;

  Uncertain() = default;
  Uncertain(int whole) : value(whole) {}
  Uncertain(Mpfr v, Mpfr e) : value(std::move(v)), error(std::move(e)) {}

  /// The value may be 0.
  bool holds_zero() const { return magnitude(value) <= error; }

  friend Uncertain operator+(const Uncertain& a, const Uncertain& b) {
    return rounded(a.value + b.value, a.error + b.error);
  }
  friend Uncertain operator-(const Uncertain& a) { return {-a.value, a.error}; }
  friend Uncertain operator-(const Uncertain& a, const Uncertain& b) { return a + -b; }
  friend Uncertain operator*(const Uncertain& a, const Uncertain& b) {
    return rounded(a.value * b.value, magnitude(a.value) * b.error + a.error * (magnitude(b.value) + b.error));
  }
  /// b must not hold 0.
  friend Uncertain operator/(const Uncertain& a, const Uncertain& b) {
    const Mpfr ratio = a.value / b.value;
    return rounded(ratio, (a.error + magnitude(ratio) * b.error) / (magnitude(b.value) - b.error));
  }

 private:
  static Uncertain rounded(const Mpfr& value, const Mpfr& error) {
    return {value, error + epsilon<Mpfr>() * magnitude(value)};
  }
};

}  // namespace hbvm::core

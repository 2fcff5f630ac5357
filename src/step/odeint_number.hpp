#pragma once

#include "scalar/scalar.hpp"

namespace hbvm::core {

/// A number of the working precision for code that mixes it with double. The step size control of Boost.odeint does so:
/// its constants are factors of safety and whole numbers. A template: double itself needs none.
template <Scalar S>
struct OdeintNumber {
  S value = 0;

  OdeintNumber() = default;
  OdeintNumber(const S& x) : value(x) {}
  template <class T>
  requires(std::is_arithmetic_v<T> && !std::same_as<T, S>) OdeintNumber(T x) : value(static_cast<S>(x)) {}

  OdeintNumber& operator+=(const OdeintNumber& b) {
    value += b.value;
    return *this;
  }
  OdeintNumber& operator*=(const OdeintNumber& b) {
    value *= b.value;
    return *this;
  }
  friend OdeintNumber operator-(const OdeintNumber& a) { return S(-a.value); }
  friend OdeintNumber operator+(const OdeintNumber& a, const OdeintNumber& b) { return S(a.value + b.value); }
  friend OdeintNumber operator-(const OdeintNumber& a, const OdeintNumber& b) { return S(a.value - b.value); }
  friend OdeintNumber operator*(const OdeintNumber& a, const OdeintNumber& b) { return S(a.value * b.value); }
  friend OdeintNumber operator/(const OdeintNumber& a, const OdeintNumber& b) { return S(a.value / b.value); }
  friend bool operator==(const OdeintNumber& a, const OdeintNumber& b) { return a.value == b.value; }
  friend bool operator<(const OdeintNumber& a, const OdeintNumber& b) { return a.value < b.value; }
  friend bool operator>(const OdeintNumber& a, const OdeintNumber& b) { return a.value > b.value; }
  friend bool operator<=(const OdeintNumber& a, const OdeintNumber& b) { return a.value <= b.value; }
  friend bool operator>=(const OdeintNumber& a, const OdeintNumber& b) { return a.value >= b.value; }
  friend OdeintNumber abs(const OdeintNumber& a) { return magnitude(a.value); }
  friend OdeintNumber pow(const OdeintNumber& a, const OdeintNumber& b) {
    using std::pow;
    return S(pow(a.value, b.value));
  }
};

}  // namespace hbvm::core

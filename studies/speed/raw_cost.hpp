#pragma once

#include "linear/operation_counts.hpp"
#include "timing.hpp"

namespace hbvm::core::speed {

/// What the operations of the working digits cost by themselves, in seconds: the library's calls on full operands.
class RawCost {
 public:
  RawCost() {
    std::vector<Mpfr> x, y;
    // No root is a whole number or a short fraction, of which mpfr_mul takes the few limbs that are not 0.
    for (int i = 1; i <= count; ++i) {
      x.push_back(sqrt(Mpfr(i * i + 1)));
      y.push_back(sqrt(Mpfr(i * i + 1) / 3));
    }
    std::vector<Mpfr> r(x);
    const auto cost = [&](auto&& call) {
      return seconds_of([&] {
               for (std::size_t i = 0; i < count; ++i) call(raw(r[i]), raw(x[i]), raw(y[i]));
             }) /
             count;
    };
    add_ = cost([](auto z, auto a, auto b) { mpfr_add(z, a, b, MPFR_RNDN); });
    multiply_ = cost([](auto z, auto a, auto b) { mpfr_mul(z, a, b, MPFR_RNDN); });
    divide_ = cost([](auto z, auto a, auto b) { mpfr_div(z, a, b, MPFR_RNDN); });
    sqrt_ = cost([](auto z, auto a, auto) { mpfr_sqrt(z, a, MPFR_RNDN); });
    sin_ = cost([](auto z, auto a, auto) { mpfr_sin(z, a, MPFR_RNDN); });
  }

  /// Sum of the counted operations times their costs.
  double of(const OperationCounts& counts) const {
    const auto n = [&](Op op) { return static_cast<double>(counts[op]); };
    return (n(Op::add) + n(Op::subtract)) * add_ + n(Op::multiply) * multiply_ + n(Op::reciprocal) * divide_ +
           n(Op::sqrt) * sqrt_ + (n(Op::sin) + n(Op::cos)) * sin_;
  }
  double add() const { return add_; }
  double multiply() const { return multiply_; }
  double divide() const { return divide_; }
  double sqrt_cost() const { return sqrt_; }
  double sin() const { return sin_; }

 private:
  static constexpr int count = 64;
  double add_, multiply_, divide_, sqrt_, sin_;
};

}  // namespace hbvm::core::speed

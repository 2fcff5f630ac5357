#pragma once

#include <cstdint>
#include <random>

#include "linear/matrix.hpp"

namespace hbvm::core {

/// Reproducible random numbers whose significands are random to the last bit of the working precision.
template <Scalar S>
class RandomValues {
 public:
  explicit RandomValues(std::uint64_t seed) : engine_(seed) {}

  long whole(long low, long high) {
    return low + static_cast<long>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }

  /// Between -1 and 1.
  S value() {
    constexpr long limb = 1L << 31;
    S x = 0;
    for (int bits = 0; bits < significand_bits<S>() + 62; bits += 31) x = (x + S(whole(0, limb - 1))) / S(limb);
    return whole(0, 1) == 0 ? x : S(-x);
  }

  Vector<S> vector(Index n) {
    Vector<S> v(n);
    for (Index i = 0; i < n; ++i) v[i] = value();
    return v;
  }

  Matrix<S> matrix(Index rows, Index columns) {
    Matrix<S> a(rows, columns);
    for (Index i = 0; i < a.size(); ++i) a.data()[i] = value();
    return a;
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace hbvm::core

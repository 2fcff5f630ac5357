#pragma once

#include <array>
#include <cstdint>

#include "linear/index.hpp"

namespace hbvm::core {

/// The operations a formula is made of. Differences of it need sinc, sinhc, atanhc and atanc, which are sin x / x, sinh
/// x / x and so on, 1 at 0.
enum class Op : std::uint8_t {
  add,
  subtract,
  multiply,
  negate,
  abs,
  sign,
  reciprocal,
  sqrt,
  sin,
  cos,
  exp,
  log,
  sinh,
  cosh,
  tanh,
  atan,
  sinc,
  sinhc,
  atanhc,
  atanc
};
inline constexpr std::size_t op_count = 20;
constexpr const char* name_of(Op op) {
  constexpr std::array<const char*, op_count> names{
      "add", "subtract", "multiply", "negate", "abs",  "sign", "divide", "sqrt",  "sin",    "cos",
      "exp", "log",      "sinh",     "cosh",   "tanh", "atan", "sinc",   "sinhc", "atanhc", "atanc"};
  return names[static_cast<std::size_t>(op)];
}
/// Whether it takes two operands.
constexpr bool is_binary(Op op) { return op == Op::add || op == Op::subtract || op == Op::multiply; }

/// How often each operation of the working precision is done, indexed by Op. (Op::reciprocal counts all divisions.)
class OperationCounts {
 public:
  std::uint64_t& operator[](Op op) { return counts_[static_cast<std::size_t>(op)]; }
  std::uint64_t operator[](Op op) const { return counts_[static_cast<std::size_t>(op)]; }
  /// n products, each added to a sum.
  void add_products(Index n) {
    (*this)[Op::multiply] += static_cast<std::uint64_t>(n);
    (*this)[Op::add] += static_cast<std::uint64_t>(n);
  }
  /// n sums of so many products.
  void add_dots(Index n, Index length) {
    (*this)[Op::multiply] += static_cast<std::uint64_t>(n * length);
    (*this)[Op::add] += static_cast<std::uint64_t>(n * (length - 1));
  }
  void add(Op op, Index n) { (*this)[op] += static_cast<std::uint64_t>(n); }
  OperationCounts& operator+=(const OperationCounts& other) {
    for (std::size_t i = 0; i < op_count; ++i) counts_[i] += other.counts_[i];
    return *this;
  }
  friend OperationCounts operator+(OperationCounts a, const OperationCounts& b) { return a += b; }
  /// The operations counted in a that are not counted in b.
  friend OperationCounts operator-(OperationCounts a, const OperationCounts& b) {
    for (std::size_t i = 0; i < op_count; ++i) a.counts_[i] -= b.counts_[i];
    return a;
  }
  friend OperationCounts operator*(std::uint64_t n, OperationCounts counts) {
    for (std::uint64_t& count : counts.counts_) count *= n;
    return counts;
  }
  std::uint64_t total() const {
    std::uint64_t sum = 0;
    for (const std::uint64_t count : counts_) sum += count;
    return sum;
  }
  friend bool operator==(const OperationCounts&, const OperationCounts&) = default;
  template <class Archive>
  void remember(Archive& archive) {
    archive(counts_);
  }

 private:
  std::array<std::uint64_t, op_count> counts_{};
};

}  // namespace hbvm::core

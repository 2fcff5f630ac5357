#pragma once

#include <concepts>
#include <type_traits>
#include <utility>

#include "linear/index.hpp"
#include "scalar/scalar.hpp"

namespace hbvm::core {

/// f(n), with n as a constant of its type where it is one of the small numbers of stages that are usual in double.
/// There the compiler unrolls what would be mostly loop. The formulas are the same, and so is the order of their sums.
template <Scalar S, class F>
decltype(auto) with_constant_count(Index n, F&& f) {
  if constexpr (std::same_as<S, double>) {
    switch (n) {
      case 1:
        return std::forward<F>(f)(std::integral_constant<Index, 1>());
      case 2:
        return std::forward<F>(f)(std::integral_constant<Index, 2>());
      case 3:
        return std::forward<F>(f)(std::integral_constant<Index, 3>());
      case 4:
        return std::forward<F>(f)(std::integral_constant<Index, 4>());
      case 5:
        return std::forward<F>(f)(std::integral_constant<Index, 5>());
      default:
        break;
    }
  }
  return std::forward<F>(f)(n);
}

/// The same for a dimension of space, inlined.
template <Scalar S, class F>
[[gnu::always_inline]] inline void with_constant_dimension(Index dimension, F f) {
  if constexpr (std::same_as<S, double>) {
    if (dimension == 3) return f(std::integral_constant<Index, 3>());
    if (dimension == 2) return f(std::integral_constant<Index, 2>());
  }
  f(dimension);
}

/// Whether the type of a count is that of a constant: sums of so many numbers can stay in registers.
template <class Count>
inline constexpr bool is_constant_count = !std::same_as<Count, Index>;

}  // namespace hbvm::core

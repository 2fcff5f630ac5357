#pragma once

#include <utility>
#include <vector>

#include "method/hbvm.hpp"

namespace hbvm::core {

template <Scalar S>
using Coefficients = std::vector<std::pair<const char*, Matrix<S>>>;

/// As many of the coefficients, from the first one on, are computed from no other.
constexpr std::size_t given_coefficients = 9;

template <Scalar S>
Coefficients<S> coefficients_of(const Hbvm<S>& m) {
  return {{"c", m.c},
          {"b", m.b},
          {"c_hat", m.c_hat},
          {"b_hat", m.b_hat},
          {"P_s", m.P_s},
          {"I_s", m.I_s},
          {"P_hat", m.P_hat},
          {"I_hat", m.I_hat},
          {"X_s", m.X_s},
          {"projection", m.projection},
          {"projection_hat", m.projection_hat},
          {"A", m.A},
          {"lambda_at_1", m.lambda_at_1}};
}

}  // namespace hbvm::core

#pragma once

#include <string_view>
#include <vector>

#include "hbvm/method.hpp"

namespace hbvm::core {

/// A Runge-Kutta method that one knows by a name: "rk4", "sdirk:3".
struct KnownTableau {
  std::string_view name;
  Tableau tableau;  ///< exact numbers
};

/// All there are.
const std::vector<KnownTableau>& known_tableaux();

}  // namespace hbvm::core

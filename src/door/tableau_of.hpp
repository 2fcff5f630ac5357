#pragma once

#include "hbvm/method.hpp"
#include "method/runge_kutta.hpp"

namespace hbvm::core {

/// \throws InputError naming the entry that has no value, and for sizes that do not fit
Tableau tableau_of(const hbvm::Tableau& tableau);

}  // namespace hbvm::core

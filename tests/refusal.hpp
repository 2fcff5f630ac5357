#pragma once

#include <string>

#include "hbvm/error.hpp"

namespace hbvm::core {

/// What the error says that f ends with.
template <class Refusal = InputError, class F>
std::string refusal_of(const F& f) {
  try {
    f();
  } catch (const Refusal& error) {
    return error.what();
  }
  return "nothing was refused";
}

}  // namespace hbvm::core

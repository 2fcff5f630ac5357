#pragma once

#include <stdexcept>

namespace hbvm::core {

/// The error that ends the work; it must end so.
template <class E, class F>
E error_of(const F& work) {
  try {
    work();
  } catch (const E& error) {
    return error;
  }
  throw std::logic_error("the work was done");
}

}  // namespace hbvm::core

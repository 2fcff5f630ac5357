#pragma once

#include "hbvm/error.hpp"
#include "scalar/scalar.hpp"

namespace hbvm::core {

/// Refuses Mpfr where no PrecisionScope is open in this thread, which would compute with Boost's default of 20 digits.
/// \throws InputError
template <Scalar S>
void require_working_digits() {
  if constexpr (std::same_as<S, Mpfr>) {
    // A scope sets this, and nothing else does.
    using boost::multiprecision::variable_precision_options;
    if (Mpfr::thread_default_variable_precision_options() != variable_precision_options::preserve_target_precision)
      throw InputError(
          "Mpfr has no working digits in this thread: open a scope of them, as hbvm::core::PrecisionScope digits(50), "
          "which "
          "every thread needs for itself");
  }
}

}  // namespace hbvm::core

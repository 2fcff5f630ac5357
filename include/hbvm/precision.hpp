#pragma once

#include <string>

namespace hbvm {

/// A working precision is named "double", "quad" (binary128) or "mpfr:N" for N decimal digits, 20 to 10000; "N" alone
/// is "mpfr:N". A run has its own: nothing is set for a thread or a process.

/// Its name as results have it, "mpfr:50" for "50". \throws InputError for what is none
std::string precision_name(const std::string& precision);
/// Its decimal digits: 15, 33 or N. \throws InputError likewise
int decimal_digits(const std::string& precision);
/// Whether this build has quad.
bool has_quad();

}  // namespace hbvm

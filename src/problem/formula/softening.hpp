#pragma once

#include "problem/effect/program.hpp"
#include "scalar/mpfr.hpp"

namespace hbvm::core {

/// The program with the arguments of all exp, sinh, cosh and tanh times one factor. These products are further outputs,
/// after those of the program. Far from a narrow bump its force is hidden, in any number of digits, by what it is added
/// to. It may also be too small for a number. With a small factor it is not. What holds of U whatever the value of an
/// exponential is holds with a factor as well. Such is a symmetry of all parts of U that such functions multiply.
Program<Mpfr> with_exponents_times(const Mpfr& factor, const Program<Mpfr>& program);

}  // namespace hbvm::core

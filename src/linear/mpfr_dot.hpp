#pragma once

#include "scalar/mpfr.hpp"

namespace hbvm::core {

/// r = sum_i x_i y_i for i < n, where x_i stands at x[i * x_stride], in one go. The products are added exactly, but for
/// what lies more than a limb below the last digit of the largest one. The sum is rounded once, so that the error is
/// that of one rounding plus n/2^64 of the last digit of the largest product. About twice as fast as mpfr_mul and
/// mpfr_add up to some hundred digits, as the products are neither rounded nor normalised.
///
/// \return false, with r unchanged, if it does not apply. Numbers may be not finite, of unequal length, or so long that
/// the product itself is all that counts
bool dot(mpfr_ptr r, const Mpfr* x, long x_stride, const Mpfr* y, long y_stride, long n);

}  // namespace hbvm::core

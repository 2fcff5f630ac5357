#pragma once

#include "scalar/quad.hpp"

#if HBVM_QUAD

namespace hbvm::core {

/// r = sum_i x_i y_i for i < n <= 256, where x_i stands at x[i * x_stride], in one go. Products are cut 2^-183 below
/// the greatest of them, and the sum is rounded once. So the error is that of one rounding, plus n 2^-183 of the
/// greatest product. It takes 0.6 of the time of products and sums one after the other, of which each waits for the one
/// before.
///
/// \return false, with r unchanged, if it does not apply. Numbers may be subnormal or not finite, or the products near
/// the ends of the exponents
bool dot(Quad& r, const Quad* x, long x_stride, const Quad* y, long y_stride, long n);

}  // namespace hbvm::core

#endif

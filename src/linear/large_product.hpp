#pragma once

#include "linear/matrix.hpp"

namespace hbvm::core {

/// a b, in the digits of the scope, for large matrices: blocks of whole numbers are multiplied by the fast product of
/// the library FLINT. An error is some units of the last digit of the greatest products of a row of a and a column of
/// b.
Matrix<Mpfr> large_product(const Matrix<Mpfr>& a, const Matrix<Mpfr>& b);

}  // namespace hbvm::core

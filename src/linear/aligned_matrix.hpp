#pragma once

#include <vector>

#include "linear/limbs.hpp"
#include "linear/matrix.hpp"

namespace hbvm::core {

/// A matrix that multiplies many vectors. Its entries are whole multiples of one unit, far below the last digit of the
/// largest. A product of a row with a vector in such units is then one of whole numbers. They need neither be shifted
/// nor rounded one by one, which takes as long as to multiply them up to some hundred digits.
///
/// Errors of a sum are those of one rounding. Each product of `l` limbs adds l 2^-(bits + guard_bits) of the largest of
/// the matrix and of the vector.
class AlignedMatrix {
 public:
  static constexpr int guard_bits = 16;

  AlignedMatrix() = default;
  /// Takes numbers of the working precision, in which times() is to be called.
  explicit AlignedMatrix(const Matrix<Mpfr>& a);

  /// r = a x, where x_l stands at x[l * stride].
  /// \return false, with r unchanged, if it does not apply. Numbers may be not finite, of another length, or so long
  /// that the product itself is all that counts
  bool times(Mpfr* r, const Mpfr* x, Index stride);

 private:
  Index rows_ = 0, columns_ = 0;
  long bits_ = 0, limbs_ = 0, exponent_ = 0;  ///< of the largest entry
  std::vector<Limb> entries_;                 ///< row by row
  std::vector<signed char> signs_;            ///< 0 of an entry that is 0
  std::vector<Limb> x_, sum_;                 ///< scratch
  std::vector<signed char> x_signs_;
};

}  // namespace hbvm::core

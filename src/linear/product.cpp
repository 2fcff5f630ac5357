#include "hbvm/linear/product.hpp"

#include "hbvm/scalar/in_place.hpp"
#include "linear/mpfr_dot.hpp"

namespace hbvm {

template <Scalar S>
void product(Matrix<S>& c, const Matrix<S>& a, const Matrix<S>& b) {
  const Index rows = a.rows(), inner = a.cols(), columns = b.cols();
  if (c.rows() != rows || c.cols() != columns) c.resize(rows, columns);
  if (inner == 0) {
    for (Index i = 0; i < c.size(); ++i) set_zero(c.data()[i]);
    return;
  }
  S& t = scratch<S>();
  for (Index j = 0; j < columns; ++j) {
    S* const out = c.data() + j * rows;
    const S* const x = b.data() + j * inner;
    if constexpr (std::same_as<S, Mpfr>) {
      Index i = 0;
      while (i < rows && dot(raw(out[i]), a.data() + i, rows, x, 1, inner)) ++i;
      if (i == rows) continue;
    }
    for (Index i = 0; i < rows; ++i) set_product(out[i], a.data()[i], x[0]);
    for (Index l = 1; l < inner; ++l) {
      const S* const column = a.data() + l * rows;
      for (Index i = 0; i < rows; ++i) add_product(out[i], column[i], x[l], t);
    }
  }
}

template <Scalar S>
S dot(const Vector<S>& a, const Vector<S>& b) {
  S sum = 0, t;
  for (Index i = 0; i < a.size(); ++i) add_product(sum, a[i], b[i], t);
  return sum;
}

#define HBVM_DEFINE(S)                                                      \
  template void product<S>(Matrix<S>&, const Matrix<S>&, const Matrix<S>&); \
  template S dot<S>(const Vector<S>&, const Vector<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm

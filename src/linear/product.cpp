#include "hbvm/linear/product.hpp"

#include "hbvm/scalar/in_place.hpp"

namespace hbvm {

template <Scalar S>
void product(Matrix<S>& c, const Matrix<S>& a, const Matrix<S>& b) {
  const Index rows = a.rows(), inner = a.cols(), columns = b.cols();
  if (c.rows() != rows || c.cols() != columns) c.resize(rows, columns);
  S t;
  for (Index j = 0; j < columns; ++j) {
    S* const out = c.data() + j * rows;
    const S* const x = b.data() + j * inner;
    for (Index i = 0; i < rows; ++i) set_zero(out[i]);
    for (Index l = 0; l < inner; ++l) {
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

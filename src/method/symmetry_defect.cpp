#include "method/symmetry_defect.hpp"

namespace hbvm::core {

template <Scalar S>
S symmetry_defect(const RungeKutta<S>& method) {
  const Index s = method.b.size();
  S worst = 0;
  for (Index i = 0; i < s; ++i) {
    raise_to(worst, magnitude(S(method.b[s - 1 - i] - method.b[i])));
    for (Index j = 0; j < s; ++j)
      raise_to(worst, magnitude(S(method.A(s - 1 - i, s - 1 - j) + method.A(i, j) - method.b[j])));
  }
  return worst;
}

template <Scalar S>
S symplecticity_defect(const RungeKutta<S>& method) {
  const Matrix<S>& A = method.A;
  const Vector<S>& b = method.b;
  S worst = 0;
  for (Index i = 0; i < b.size(); ++i)
    for (Index j = 0; j <= i; ++j) raise_to(worst, magnitude(S(b[i] * A(i, j) + b[j] * A(j, i) - b[i] * b[j])));
  return worst;
}

#define HBVM_DEFINE(S)                                 \
  template S symmetry_defect<S>(const RungeKutta<S>&); \
  template S symplecticity_defect<S>(const RungeKutta<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

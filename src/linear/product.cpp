#include "linear/product.hpp"

#include "linear/arrays.hpp"
#include "linear/constant_count.hpp"
#include "linear/mpfr_dot.hpp"
#include "linear/quad_dot.hpp"
#include "scalar/in_place.hpp"

namespace hbvm::core {
namespace {

/// r = sum_i x_i y_i in one go. \return false if there is no such way, or it does not apply
template <Scalar S>
bool dot_at_once([[maybe_unused]] S& r, [[maybe_unused]] const S* x, [[maybe_unused]] Index x_stride,
                 [[maybe_unused]] const S* y, [[maybe_unused]] Index y_stride, [[maybe_unused]] Index n) {
  if constexpr (std::same_as<S, Mpfr>)
    return dot(raw(r), x, x_stride, y, y_stride, n);
  else if constexpr (std::same_as<S, Quad>)
    return n > 1 && dot(r, x, x_stride, y, y_stride, n);
  else
    return false;
}

/// r = sum_l x_l a_l, column by column of `rows` entries.
template <Scalar S, class Rows, class Terms>
void add_columns(S* r, Rows rows, const S* a, Terms inner, const S* x, Index x_stride) {
  if constexpr (is_constant_count<Rows>) {
    S sums[Rows::value];
    for (Index i = 0; i < rows; ++i) sums[i] = a[i] * x[0];
    for (Index l = 1; l < inner; ++l)
      for (Index i = 0; i < rows; ++i) sums[i] += a[l * rows + i] * x[l * x_stride];
    for (Index i = 0; i < rows; ++i) r[i] = sums[i];
  } else {
    S& t = scratch<S>();
    for (Index i = 0; i < rows; ++i) set_product(r[i], a[i], x[0]);
    for (Index l = 1; l < inner; ++l) {
      const S* const column = a + l * rows;
      const S& factor = x[l * x_stride];
      for (Index i = 0; i < rows; ++i) add_product(r[i], column[i], factor, t);
    }
  }
}

}  // namespace

template <Scalar S>
void set_times(S* r, const Matrix<S>& a, const S* x, Index x_stride) {
  const Index rows = a.rows(), inner = a.cols();
  if (inner == 0) {
    for (Index i = 0; i < rows; ++i) set_zero(r[i]);
    return;
  }
  Index i = 0;
  while (i < rows && dot_at_once(r[i], a.data() + i, rows, x, x_stride, inner)) ++i;
  if (i == rows) return;
  with_constant_count<S>(rows, [&](auto count) { add_columns(r, count, a.data(), inner, x, x_stride); });
}

template <Scalar S>
void product(Matrix<S>& c, const Matrix<S>& a, const Matrix<S>& b) {
  const Index rows = a.rows(), inner = a.cols(), columns = b.cols();
  if (c.rows() != rows || c.cols() != columns) c.resize(rows, columns);
  if constexpr (std::same_as<S, double>) {
    if (inner == 0) return set_zero(c);
    return with_constant_count<S>(rows, [&]<class Rows>(Rows count) {
      const auto any_terms = [&] {
        for (Index j = 0; j < columns; ++j)
          add_columns(c.data() + j * count, count, a.data(), inner, b.data() + j * inner, 1);
      };
      if constexpr (is_constant_count<Rows>)
        with_constant_count<S>(inner, [&]<class Terms>(Terms) {
          if constexpr (is_constant_count<Terms>)
            multiply_few<Rows::value, Terms::value>(c.data(), a.data(), b.data(), columns);
          else
            any_terms();
        });
      else
        any_terms();
    });
  }
  for (Index j = 0; j < columns; ++j) set_times(c.data() + j * rows, a, b.data() + j * inner, 1);
}

template <Scalar S>
S dot(const Vector<S>& a, const Vector<S>& b) {
  S sum = 0, t;
  for (Index i = 0; i < a.size(); ++i) add_product(sum, a[i], b[i], t);
  return sum;
}

template <Scalar S>
void set_dot(S& r, const S* x, Index x_stride, const S* y, Index y_stride, Index n) {
  if (dot_at_once(r, x, x_stride, y, y_stride, n)) return;
  S sum = 0, lost = 0, term, rest, next, t;
  for (Index i = 0; i < n; ++i) {
    const S& a = x[i * x_stride];
    const S& b = y[i * y_stride];
    if (a == 0) continue;
    if constexpr (std::same_as<S, Quad>) {
      add_product(sum, a, b, t);
    } else {
      set_exact_product(term, rest, a, b);
      set_sum(lost, lost, rest);
      set_exact_sum(next, rest, sum, term, t);
      set_sum(lost, lost, rest);
      using std::swap;
      swap(sum, next);  // Boost's own: no number is moved from, and then assigned to
    }
  }
  set_sum(r, sum, lost);
}

#define HBVM_DEFINE(S)                                                      \
  template void product<S>(Matrix<S>&, const Matrix<S>&, const Matrix<S>&); \
  template void set_times<S>(S*, const Matrix<S>&, const S*, Index);        \
  template S dot<S>(const Vector<S>&, const Vector<S>&);                    \
  template void set_dot<S>(S&, const S*, Index, const S*, Index, Index);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

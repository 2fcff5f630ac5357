#include "linear/parity_matrix.hpp"

#include <algorithm>
#include <utility>

#include "scalar/in_place.hpp"

namespace hbvm::core {

template <Scalar S>
ParityMatrix<S>::ParityMatrix(const Matrix<S>& a, Nodes nodes, First first)
    : nodes_(nodes),
      n_(nodes == Nodes::rows ? a.rows() : a.cols()),
      functions_(nodes == Nodes::rows ? a.cols() : a.rows()),
      first_even_(first == First::even ? 0 : 1),
      first_odd_(1 - first_even_),
      mirrored_(find_mirrored(a)) {
  if (!mirrored_) {
    whole_ = Part(a);
    return;
  }
  const Index half = n_ / 2, with_middle = n_ - half;
  const Index evens = (functions_ + first_odd_) / 2, odds = functions_ - evens;
  const auto part = [&](Index first_function, Index count, Index length) {
    Matrix<S> result(nodes_ == Nodes::rows ? length : count, nodes_ == Nodes::rows ? count : length);
    for (Index j = 0; j < count; ++j)
      for (Index i = 0; i < length; ++i) {
        const Index function = first_function + 2 * j;
        if (nodes_ == Nodes::rows)
          result(i, j) = a(i, function);
        else
          result(j, i) = a(function, i);
      }
    return result;
  };
  even_ = Part(part(first_even_, evens, with_middle));
  odd_ = Part(part(first_odd_, odds, half));
  even_half_.resize(with_middle);
  odd_half_.resize(half);
  turns_.resize(std::max(evens, odds));
}

template <Scalar S>
bool ParityMatrix<S>::find_mirrored(const Matrix<S>& a) const {
  // In double both ways take the same time at about 16 nodes and functions.
  constexpr Index small = 256;
  if (std::same_as<S, double> && a.size() < small) return false;
  // Each of two entries is rounded from values at a rounded node: a few units of its own.
  constexpr int units = 8;
  const auto at = [&](Index node, Index function) -> const S& {
    return nodes_ == Nodes::rows ? a(node, function) : a(function, node);
  };
  S largest, defect, allowed;
  const S relative = units * epsilon<S>();
  for (Index j = 0; j < functions_; ++j) {
    hbvm::core::set_zero(largest);
    for (Index i = 0; i < n_; ++i) raise_magnitude(largest, at(i, j));
    for (Index i = 0; 2 * i < n_; ++i) {
      const S &here = at(i, j), &there = at(n_ - 1 - i, j);
      const bool middle = 2 * i + 1 == n_;
      if (is_even(j))
        set_difference(defect, here, there);
      else
        set_sum(defect, here, there);
      set_product(allowed, relative, middle ? largest : here);
      if (exceeds(defect, allowed)) return false;
    }
  }
  return true;
}

template <Scalar S>
ParityMatrix<S>::Part::Part(Matrix<S> matrix) : a(std::move(matrix)) {
  // To bring the vector to one unit takes as long as to multiply it by three rows.
  constexpr Index small = 16;
  if constexpr (std::same_as<S, Mpfr>)
    if (a.size() >= small) aligned = AlignedMatrix(a);
}

template <Scalar S>
void ParityMatrix<S>::Part::times(S* r, const S* x, Index stride) {
  if constexpr (std::same_as<S, Mpfr>)
    if (aligned.times(r, x, stride)) return;
  set_times(r, a, x, stride);
}

template <Scalar S>
void ParityMatrix<S>::take_turns(S* r, Index first, Part& part, const S* x) {
  part.times(turns_.data(), x, 1);
  for (Index i = 0; i < part.a.rows(); ++i) set(r[first + 2 * i], turns_[i]);
}

template <Scalar S>
void ParityMatrix<S>::add(Matrix<S>& c, const Vector<S>& plus) {
  S* out = c.data();
  for (Index j = 0; j < c.cols(); ++j)
    for (Index i = 0; i < c.rows(); ++i, ++out) set_sum(*out, *out, plus[j]);
}

template <Scalar S>
void ParityMatrix<S>::times(Matrix<S>& c, const Matrix<S>& b) {
  if (!mirrored_) {
    if (c.rows() != whole_.a.rows() || c.cols() != b.cols()) c.resize(whole_.a.rows(), b.cols());
    if constexpr (std::same_as<S, Mpfr>)
      for (Index j = 0; j < b.cols(); ++j) whole_.times(&c(0, j), &b(0, j), 1);
    else
      product(c, whole_.a, b);
    return;
  }
  const Index half = n_ / 2, rows = nodes_ == Nodes::rows ? n_ : functions_, inner = b.rows(), columns = b.cols();
  if (c.rows() != rows || c.cols() != columns) c.resize(rows, columns);
  S* const even = even_half_.data();
  S* const odd = odd_half_.data();
  for (Index j = 0; j < columns; ++j) {
    S* const out = c.data() + j * rows;
    const S* const x = b.data() + j * inner;
    if (nodes_ == Nodes::rows) {
      even_.times(even, x + first_even_, 2);
      odd_.times(odd, x + first_odd_, 2);
      for (Index i = 0; i < half; ++i) {
        set_sum(out[i], even[i], odd[i]);
        set_difference(out[n_ - 1 - i], even[i], odd[i]);
      }
      if (n_ % 2 != 0) set(out[half], even[half]);
    } else {
      for (Index i = 0; i < half; ++i) {
        set_sum(even[i], x[i], x[n_ - 1 - i]);
        set_difference(odd[i], x[i], x[n_ - 1 - i]);
      }
      if (n_ % 2 != 0) set(even[half], x[half]);
      take_turns(out, first_even_, even_, even);
      take_turns(out, first_odd_, odd_, odd);
    }
  }
}

template <Scalar S>
OperationCounts ParityMatrix<S>::operations(Index columns) const {
  OperationCounts counts;
  const auto add = [&](const Matrix<S>& a) {
    if (a.size() > 0) counts.add_dots(columns * a.rows(), a.cols());
  };
  if (!mirrored_) {
    add(whole_.a);
    return counts;
  }
  add(even_.a);
  add(odd_.a);
  counts.add(Op::add, columns * (n_ / 2));
  counts.add(Op::subtract, columns * (n_ / 2));
  return counts;
}

#define HBVM_DEFINE(S) template class ParityMatrix<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

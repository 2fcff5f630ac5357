#include "problem/mass_matrix.hpp"

#include "hbvm/error.hpp"
#include "linear/product.hpp"
#include "scalar/in_place.hpp"

namespace hbvm::core {
namespace {

/// M^-1 by M = L D L^T with twice the working digits, rounded once.
template <Scalar S>
Matrix<S> inverse(const Matrix<S>& M) {
  const Index n = M.rows();
  const int digits = digits10<S>();
  const PrecisionScope guarded(static_cast<unsigned>(2 * digits + 10));
  Matrix<Mpfr> L = Matrix<Mpfr>::Identity(n, n);
  Vector<Mpfr> D(n);
  const auto exact = [&](Index i, Index j) { return rounded_to<Mpfr>(raw(exactly(M(i, j)))); };
  for (Index j = 0; j < n; ++j) {
    for (Index i = j; i < n; ++i) {
      Mpfr sum = exact(i, j);
      for (Index l = 0; l < j; ++l) sum -= L(i, l) * L(j, l) * D[l];
      if (i > j)
        L(i, j) = sum / D[j];
      else if (sum > 0)
        D[j] = sum;
      else
        throw InputError("the mass matrix is not positive definite");
    }
  }
  Matrix<Mpfr> W(n, n);
  for (Index column = 0; column < n; ++column) {
    Vector<Mpfr> x = Vector<Mpfr>::Unit(n, column);
    for (Index i = 0; i < n; ++i)
      for (Index l = 0; l < i; ++l) x[i] -= L(i, l) * x[l];
    for (Index i = 0; i < n; ++i) x[i] /= D[i];
    for (Index i = n - 1; i >= 0; --i)
      for (Index l = i + 1; l < n; ++l) x[i] -= L(l, i) * x[l];
    W.col(column) = x;
  }
  const PrecisionScope working(static_cast<unsigned>(digits));
  Matrix<S> result(n, n);
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i) result(i, j) = rounded_to<S>(raw(W(std::min(i, j), std::max(i, j))));
  return result;
}

}  // namespace

template <Scalar S>
void MassMatrix<S>::add_scalar(Index size, const S& mass) {
  if (!(mass > 0)) throw InputError("a mass must be positive");
  blocks_.push_back({m_, size, false, mass, S(1 / mass), {}, {}});
  if (!spans_.empty() && spans_.back().offset + spans_.back().size == m_ && spans_.back().mass == mass)
    spans_.back().size += size;
  else
    spans_.push_back({m_, size, mass, blocks_.back().inverse_mass});
  inverse_masses_.resize(static_cast<std::size_t>(m_ + size), blocks_.back().inverse_mass);
  m_ += size;
}

template <Scalar S>
void MassMatrix<S>::add_full(const Matrix<S>& M) {
  for (Index j = 0; j < M.cols(); ++j)
    for (Index i = 0; i < j; ++i)
      if (M(i, j) != M(j, i)) throw InputError("the mass matrix is not symmetric");
  full_.push_back(blocks_.size());
  blocks_.push_back({m_, M.rows(), true, S(0), S(0), M, inverse(M)});
  m_ += M.rows();
}

template <Scalar S>
void MassMatrix<S>::add_driven(Index size) {
  spans_.push_back({m_, size, S(0), S(0)});
  inverse_masses_.resize(static_cast<std::size_t>(m_ + size), S(0));
  m_ += size;
}

template <Scalar S>
void MassMatrix<S>::velocity(Lanes<const S> p, Lanes<S> v) const {
  for (const Span& span : spans_) {
    S* __restrict const out = v[span.offset];
    const S* __restrict const in = p[span.offset];
    const Index size = span.size * p.count;
    if (span.mass == 1)
      for (Index i = 0; i < size; ++i) set(out[i], in[i]);
    else
      for (Index i = 0; i < size; ++i) set_product(out[i], span.inverse_mass, in[i]);
  }
  for (const std::size_t b : full_) {
    const Block& block = blocks_[b];
    S* const out = v[block.offset];
    const S* const in = p[block.offset];
    for (Index j = 0; j < block.size; ++j)
      for (Index i = 0; i < p.count; ++i)
        set_dot(out[j * p.count + i], &block.W(0, j), 1, in + i, p.count, block.size);  // W is symmetric
  }
}

template <Scalar S>
Vector<S> MassMatrix<S>::momentum(const Vector<S>& v) const {
  Vector<S> p(m_);
  momentum(v, p);
  return p;
}

template <Scalar S>
void MassMatrix<S>::momentum(const Vector<S>& v, Vector<S>& p) const {
  S& t = scratch<S>();
  for (const Block& block : blocks_) {
    for (Index j = 0; j < block.size; ++j) {
      S& sum = p[block.offset + j];
      if (!block.full) {
        set_product(sum, block.mass, v[block.offset + j]);
        continue;
      }
      set_zero(sum);
      for (Index l = 0; l < block.size; ++l) add_product(sum, block.M(j, l), v[block.offset + l], t);
    }
  }
  for (Index j = of_bodies(); j < m_; ++j) set_zero(p[j]);
}

#define HBVM_DEFINE(S) template class MassMatrix<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

#include "linear/large_product.hpp"

#include "scalar/arb.hpp"

namespace hbvm::core {
namespace {

/// The middles alone count.
class Middles {
 public:
  Middles(Index rows, Index columns) { arb_mat_init(value_, rows, columns); }
  explicit Middles(const Matrix<Mpfr>& a) : Middles(a.rows(), a.cols()) {
    for (Index i = 0; i < a.rows(); ++i)
      for (Index j = 0; j < a.cols(); ++j) arf_set_mpfr(arb_midref(arb_mat_entry(value_, i, j)), raw(a(i, j)));
  }
  Middles(const Middles&) = delete;
  Middles& operator=(const Middles&) = delete;
  ~Middles() { arb_mat_clear(value_); }

  void set_product(const Middles& a, const Middles& b) {
    arb_mat_approx_mul(value_, a.value_, b.value_, mpfr_working_bits());
  }
  void get(Mpfr& x, Index i, Index j) const {
    arf_get_mpfr(raw(x), arb_midref(arb_mat_entry(value_, i, j)), MPFR_RNDN);
  }

 private:
  arb_mat_t value_;
};

}  // namespace

Matrix<Mpfr> large_product(const Matrix<Mpfr>& a, const Matrix<Mpfr>& b) {
  Middles product(a.rows(), b.cols());
  product.set_product(Middles(a), Middles(b));
  Matrix<Mpfr> result(a.rows(), b.cols());
  for (Index i = 0; i < a.rows(); ++i)
    for (Index j = 0; j < b.cols(); ++j) product.get(result(i, j), i, j);
  return result;
}

}  // namespace hbvm::core

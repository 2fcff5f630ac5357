#include "reference/closed_form/elliptic.hpp"
#include "reference/closed_form/recognition.hpp"
#include "reference/closed_form/symmetric_eigen.hpp"

namespace hbvm::core {
namespace {

/// M q'' = f + A (q - q_0), A = d2U/dq2 constant, without constraints. Let M = L L^T and let the eigenvectors of L^-1 A
/// L^-T be the columns of Q. Then eta = Q^T L^T (q - q_0) fulfils eta'' = phi + mu eta, one by one, so that
///
///     eta = eta'_0 t c_1 + phi t^2 c_2,   eta' = eta'_0 c_0 + phi t c_1,   c_k of -mu t^2
///
/// by Stumpff's functions: an oscillation, a fall or an escape.
class Oscillator : public ClosedForm {
 public:
  Oscillator(const Recognition& content, const Matrix<Mpfr>& mass, const Vector<Mpfr>& force,
             const Matrix<Mpfr>& stiffness)
      : ClosedForm(content.scene.problem), q0_(content.scene.q0) {
    const Index m = q0_.size();
    const Matrix<Mpfr> L = cholesky(mass);
    Matrix<Mpfr> B = stiffness;
    for (Index j = 0; j < m; ++j) forward(L, B.col(j).data());
    B.transposeInPlace();
    for (Index j = 0; j < m; ++j) forward(L, B.col(j).data());
    SymmetricEigen eigen(B);
    mu_ = eigen.values;
    to_q_ = eigen.vectors;
    to_p_ = multiplied(L, eigen.vectors);
    for (Index j = 0; j < m; ++j) backward(L, to_q_.col(j).data());
    // eta'_0 = Q^T L^-1 p_0 and phi = Q^T L^-1 f, where to_q is L^-T Q.
    rate_ = transposed_times(to_q_, content.scene.p0);
    push_ = transposed_times(to_q_, force);
    for (Index j = 0; j < stiffness.size(); ++j) oscillates_ = oscillates_ || stiffness.data()[j] != 0;
  }
  std::string name() const override {
    return oscillates_ ? "harmonic oscillators (circular functions of normal modes)" : "motion under constant forces";
  }

 private:
  State state(const Mpfr& t) const override {
    const Index m = q0_.size();
    State now{q0_, Vector<Mpfr>::Zero(m)};
    for (Index i = 0; i < m; ++i) {
      const StumpffFunctions c = stumpff_functions(Mpfr(-mu_[i] * t * t));
      const Mpfr eta = t * (rate_[i] * c.c1 + push_[i] * t * c.c2), change = rate_[i] * c.c0 + push_[i] * t * c.c1;
      for (Index j = 0; j < m; ++j) {
        now.q[j] += to_q_(j, i) * eta;
        now.p[j] += to_p_(j, i) * change;
      }
    }
    return now;
  }

  static Matrix<Mpfr> cholesky(const Matrix<Mpfr>& a) {
    Matrix<Mpfr> L = Matrix<Mpfr>::Zero(a.rows(), a.cols());
    for (Index j = 0; j < a.cols(); ++j)
      for (Index i = j; i < a.rows(); ++i) {
        Mpfr sum = a(i, j);
        for (Index l = 0; l < j; ++l) sum -= L(i, l) * L(j, l);
        L(i, j) = i == j ? Mpfr(sqrt(sum)) : Mpfr(sum / L(j, j));
      }
    return L;
  }
  /// x = L^-1 x and x = L^-T x.
  static void forward(const Matrix<Mpfr>& L, Mpfr* x) {
    for (Index i = 0; i < L.rows(); ++i) {
      for (Index l = 0; l < i; ++l) x[i] -= L(i, l) * x[l];
      x[i] /= L(i, i);
    }
  }
  static void backward(const Matrix<Mpfr>& L, Mpfr* x) {
    for (Index i = L.rows(); i-- > 0;) {
      for (Index l = i + 1; l < L.rows(); ++l) x[i] -= L(l, i) * x[l];
      x[i] /= L(i, i);
    }
  }
  static Vector<Mpfr> transposed_times(const Matrix<Mpfr>& a, const Vector<Mpfr>& x) {
    Vector<Mpfr> result(a.cols());
    for (Index j = 0; j < a.cols(); ++j) result[j] = inner(Vector<Mpfr>(a.col(j)), x);
    return result;
  }

  Vector<Mpfr> q0_, mu_, rate_, push_;
  Matrix<Mpfr> to_q_, to_p_;
  bool oscillates_ = false;
};

}  // namespace

std::unique_ptr<ClosedForm> oscillator_of(const Recognition& content) {
  const Problem<Mpfr>& problem = content.scene.problem;
  // The eigenvalues of a greater matrix take longer than the motion.
  constexpr Index most_coordinates = 64;
  const Index m = problem.m(), d = content.dimension;
  if (problem.nu() > 0 || m > most_coordinates) return nullptr;
  for (const Acting& a : content.acting)
    if (a.term->degree < 0 || a.term->degree > 2) return nullptr;
  Vector<Mpfr> force = Vector<Mpfr>::Zero(m);
  Matrix<Mpfr> stiffness = Matrix<Mpfr>::Zero(m, m), mass = stiffness;
  for (const Acting& a : content.acting) {
    const Vector<Mpfr> at = a.place(content.scene.q0, d), gradient = a.gradient(at);
    const Matrix<Mpfr> hessian = a.hessian(at);
    a.for_each_coordinate(d, [&](Index i, Index row, const Mpfr& weight) {
      force[row] += weight * gradient[i];
      a.for_each_coordinate(d, [&](Index j, Index column, const Mpfr& other) {
        stiffness(row, column) += Mpfr(weight * other) * hessian(i, j);
      });
    });
  }
  for (const auto& block : problem.mass.blocks())
    for (Index i = 0; i < block.size; ++i)
      for (Index j = 0; j < block.size; ++j)
        mass(block.offset + i, block.offset + j) = block.full ? block.M(i, j) : i == j ? block.mass : Mpfr(0);
  return std::make_unique<Oscillator>(content, mass, force, stiffness);
}

}  // namespace hbvm::core

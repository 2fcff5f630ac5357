#include "scheme/facts.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>

#include "method/symmetry_defect.hpp"
#include "scalar/text.hpp"

namespace hbvm::core {
namespace {

using Complex = std::complex<double>;

class FactFinder {
 public:
  FactFinder(const Scheme& scheme, const std::vector<Mpfr>& values, const Rounding& rounding, int order)
      : scheme_(scheme), values_(values), rounding_(rounding), order_(order) {}

  std::vector<std::string> find() {
    const std::string family = scheme_.family();
    if (family == "runge_kutta") of_runge_kutta();
    if (family == "multistep") of_multistep();
    if (family == "splitting") of_splitting();
    if (family == "composition" && scheme_.has("gamma"))
      say_if("symmetric", palindrome(scheme_.vector("gamma", values_)));
    return facts_;
  }

 private:
  /// Says so if the defects are as small as rounding leaves them, or that it is not.
  void say_if(const std::string& what, const std::vector<Mpfr>& defects) {
    const double digits = digits_met(defects);
    const double enough = rounding_.digits > 0 ? rounding_.digits - 2 : static_cast<int>(rounding_.working_digits) - 30;
    if (digits < enough)
      facts_.push_back("not " + what);
    else if (rounding_.digits > 0 && digits < rounding_.working_digits - 1)
      facts_.push_back(fmt::format("{} to {:.0f} digits", what, std::floor(digits)));
    else
      facts_.push_back(what);
  }

  void of_runge_kutta() {
    const Matrix<Mpfr> A = scheme_.matrix("A", values_);
    const Vector<Mpfr> b = scheme_.vector("b", values_);
    const Index s = b.size();
    bool lower = true, strictly = true;
    for (Index i = 0; i < s; ++i)
      for (Index j = i; j < s; ++j) {
        strictly = strictly && A(i, j) == 0;
        lower = lower && (i == j || A(i, j) == 0);
      }
    facts_.push_back(strictly ? "explicit" : lower ? "diagonally implicit" : "implicit");
    std::vector<Mpfr> last;
    for (Index j = 0; j < s; ++j) last.push_back(A(s - 1, j) - b[j]);
    if (digits_met(last) > 2) say_if(strictly ? "first same as last" : "stiffly accurate", last);
    const RungeKutta<Mpfr> method{A, b, {}};
    say_if("symplectic", {symplecticity_defect(method)});
    say_if("symmetric", {symmetry_defect(method)});
    A_ = A.unaryExpr([](const Mpfr& x) { return approximately(x); });
    b_ = b.unaryExpr([](const Mpfr& x) { return approximately(x); });
    if (strictly) {
      facts_.push_back(fmt::format("stability interval {:.3g} on the negative real axis, {:.3g} on the imaginary axis",
                                   interval(Complex(-1, 0)), interval(Complex(0, 1))));
    } else if (Eigen::FullPivLU<Eigen::MatrixXd> lu(A_); lu.isInvertible()) {
      const double at_infinity = 1 - b_.dot(lu.solve(Eigen::VectorXd::Ones(s)));
      facts_.push_back(
          fmt::format("R(inf) = {:.3g}", std::abs(at_infinity) < 4'096 * epsilon<double>() ? 0 : at_infinity));
    }
  }

  /// R(z) = 1 + z b^T (I - z A)^-1 1.
  Complex stability(Complex z) const {
    const Index s = b_.size();
    const Eigen::MatrixXcd system = Eigen::MatrixXcd::Identity(s, s) - z * A_.cast<Complex>();
    const Eigen::VectorXcd ones = Eigen::VectorXcd::Ones(s);
    return Complex(1) + z * b_.cast<Complex>().dot(system.partialPivLu().solve(ones));
  }

  /// How far |R| stays at most 1 in a direction.
  double interval(Complex direction) const {
    constexpr double step = 1 / double(256), farthest = 100;
    const double slack = epsilon<double>() * (1 << 22);
    const auto is_stable = [&](double x) { return std::abs(stability(x * direction)) <= 1 + slack; };
    double inside = 0;
    while (inside < farthest && is_stable(inside + step)) inside += step;
    double outside = inside + step;
    for (int n = 0; n < 40; ++n) {
      const double middle = (inside + outside) / 2;
      (is_stable(middle) ? inside : outside) = middle;
    }
    return inside < step ? 0 : inside;
  }

  void of_multistep() {
    const Vector<Mpfr> alpha = scheme_.vector("alpha", values_), beta = scheme_.vector("beta", values_);
    const Index k = alpha.size() - 1;
    facts_.push_back(beta[k] == 0 ? "explicit" : "implicit");
    if (alpha[k] == 0) return;
    // The roots of sum alpha_j z^j lie in the disc, and those on its edge are simple.
    Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(k, k);
    for (Index j = 0; j < k; ++j) {
      companion(j, k - 1) = -approximately(Mpfr(alpha[j] / alpha[k]));
      if (j > 0) companion(j, j - 1) = 1;
    }
    const Eigen::VectorXcd roots = companion.eigenvalues();
    const double near = std::cbrt(epsilon<double>());  // what rounding leaves of a double root
    bool stable = true;
    for (Index i = 0; i < k; ++i) {
      stable = stable && std::abs(roots[i]) < 1 + near;
      for (Index j = 0; j < i; ++j)
        stable = stable && (std::abs(roots[i] - roots[j]) > near || std::abs(roots[i]) < 1 - near);
    }
    facts_.push_back(stable ? "zero-stable" : "not zero-stable");
    Mpfr constant = 0, sum = 0, factorial = 1;
    for (int n = 2; n <= order_ + 1; ++n) factorial *= n;
    for (Index j = 0; j <= k; ++j) {
      const Mpfr power = order_ == 0 ? Mpfr(1) : Mpfr(pow(Mpfr(static_cast<long>(j)), order_));
      constant += (alpha[j] * static_cast<long>(j) - (order_ + 1) * beta[j]) * power;
      sum += beta[j];
    }
    if (sum != 0) facts_.push_back("error constant " + to_scientific(Mpfr(constant / factorial / sum), 4));
  }

  void of_splitting() {
    std::vector<Mpfr> defects = palindrome(scheme_.vector("a", values_));
    const std::vector<Mpfr> others = palindrome(scheme_.vector("b", values_));
    defects.insert(defects.end(), others.begin(), others.end());
    if (scheme_.vector("a", values_).size() == scheme_.vector("b", values_).size())
      facts_.push_back("not symmetric");
    else
      say_if("symmetric", defects);
  }

  static std::vector<Mpfr> palindrome(const Vector<Mpfr>& x) {
    std::vector<Mpfr> off;
    for (Index i = 0; i < x.size() / 2; ++i) off.push_back(x[i] - x[x.size() - 1 - i]);
    return off;
  }

  const Scheme& scheme_;
  const std::vector<Mpfr>& values_;
  const Rounding& rounding_;
  int order_;
  Eigen::MatrixXd A_;
  Eigen::VectorXd b_;
  std::vector<std::string> facts_;
};

}  // namespace

std::vector<std::string> facts_of(const Scheme& scheme, const std::vector<Mpfr>& values, const Rounding& rounding,
                                  int order) {
  return FactFinder(scheme, values, rounding, order).find();
}

}  // namespace hbvm::core

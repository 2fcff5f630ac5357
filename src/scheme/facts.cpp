#include "scheme/facts.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <complex>

#include "method/order_conditions.hpp"
#include "method/rooted_trees.hpp"
#include "method/symmetry_defect.hpp"
#include "scalar/text.hpp"
#include "scheme/stability.hpp"

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
    if (family == "rosenbrock") of_rosenbrock();
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
    const Eigen::MatrixXd A_near = nearest_doubles(A);
    const Eigen::VectorXd b_near = nearest_doubles(b);
    const bool is_a_stable = say_linear_stability(A_near, b_near, strictly);
    if (is_a_stable)
      facts_.push_back(is_algebraically_stable(A_near, b_near) ? "algebraically stable" : "not algebraically stable");
    const double ssp = ssp_coefficient(A_near, b_near);
    if (ssp > 0) facts_.push_back(fmt::format("SSP coefficient {:.4g}", ssp));
    say_error_constant(method);
  }

  static Eigen::MatrixXd nearest_doubles(const Matrix<Mpfr>& x) {
    return x.unaryExpr([](const Mpfr& entry) { return approximately(entry); });
  }

  /// \return whether the method is A-stable
  bool say_linear_stability(const Eigen::MatrixXd& A, const Eigen::VectorXd& b, bool is_explicit) {
    const LinearStability linear(A, b);
    if (is_explicit) {
      facts_.push_back(fmt::format("stability interval {:.3g} on the negative real axis, {:.3g} on the imaginary axis",
                                   linear.interval(Complex(-1, 0)), linear.interval(Complex(0, 1))));
      return false;
    }
    const std::optional<double> at_infinity = linear.at_infinity();
    if (at_infinity) facts_.push_back(fmt::format("R(inf) = {:.3g}", *at_infinity));
    constexpr double right_angle = 90;
    const double angle = linear.angle();
    if (angle == right_angle)
      facts_.push_back(at_infinity && *at_infinity == 0 ? "L-stable" : "A-stable");
    else
      facts_.push_back(angle > 0 ? fmt::format("A(alpha)-stable, alpha = {:.1f} degrees", angle)
                                 : std::string("not A-stable"));
    return angle == right_angle;
  }

  /// Of y' = lambda y a Rosenbrock method makes what a Runge-Kutta method with A = alpha + gamma does.
  void of_rosenbrock() {
    const Matrix<Mpfr> A = scheme_.matrix("alpha", values_) + scheme_.matrix("gamma", values_);
    say_linear_stability(nearest_doubles(A), nearest_doubles(scheme_.vector("b", values_)), false);
  }

  /// The norm of what the trees of the next order leave: (Phi(t) - 1/gamma(t)) / sigma(t), each.
  void say_error_constant(const RungeKutta<Mpfr>& method) {
    if (order_ < 1 || order_ >= max_tree_order) return;
    const std::vector<RootedTree> trees = rooted_trees(order_ + 1);
    const std::vector<Mpfr> residuals = order_residuals(method, order_ + 1).back();
    std::vector<double> symmetry;
    double sum = 0;
    std::size_t n = 0;
    for (const RootedTree& tree : trees) {
      symmetry.push_back(symmetry_of(tree, symmetry));
      if (tree.order != order_ + 1) continue;
      const double left = approximately(residuals[n++]) / (static_cast<double>(tree.density) * symmetry.back());
      sum += left * left;
    }
    facts_.push_back(fmt::format("error constant {:.3g}", std::sqrt(sum)));
  }

  /// In how many ways a tree is mapped to itself: equal subtrees, which stand together, change places.
  static double symmetry_of(const RootedTree& tree, const std::vector<double>& of_smaller) {
    double ways = 1;
    int equal = 0;
    for (std::size_t i = 0; i < tree.subtrees.size(); ++i) {
      equal = i > 0 && tree.subtrees[i] == tree.subtrees[i - 1] ? equal + 1 : 1;
      ways *= equal * of_smaller[static_cast<std::size_t>(tree.subtrees[i])];
    }
    return ways;
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
  std::vector<std::string> facts_;
};

}  // namespace

std::vector<std::string> facts_of(const Scheme& scheme, const std::vector<Mpfr>& values, const Rounding& rounding,
                                  int order) {
  return FactFinder(scheme, values, rounding, order).find();
}

}  // namespace hbvm::core

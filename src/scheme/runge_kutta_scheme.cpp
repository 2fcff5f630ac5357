#include "method/order_conditions.hpp"
#include "scheme/families.hpp"

namespace hbvm::core {
namespace {

constexpr int highest_of_runge_kutta = 12;

/// A and b. There may be c, b_hat of an embedded method, and weights at any time theta of the step, which are
/// b_i(theta) = sum_m b_theta[i][m] theta^m.
class RungeKuttaScheme final : public SchemeByTemplate<RungeKuttaScheme> {
 public:
  explicit RungeKuttaScheme(const SchemeText& text) {
    const std::size_t s = row_length(text, "b");
    take(text, "A", s, s);
    take(text, "b", 1, s);
    const int highest = std::min(highest_of_runge_kutta, 2 * static_cast<int>(s));
    add_part(text, "order", "order", highest);
    if (text.arrays.contains("c")) take(text, "c", 1, s);
    if (text.arrays.contains("b_hat")) {
      take(text, "b_hat", 1, s);
      add_part(text, "embedded order", "embedded_order", highest);
    }
    if (text.arrays.contains("b_theta")) {
      take(text, "b_theta", s, row_length(text, "b_theta"));
      add_part(text, "order at any time", "dense_order", highest);
    }
  }

  std::string family() const override { return "runge_kutta"; }

  template <class S>
  std::vector<S> residuals_in(std::size_t part, int order, const std::vector<S>& values) const {
    RungeKutta<S> method{matrix("A", values), vector("b", values), {}};
    const std::string& what = parts()[part].name;
    if (what == "order") return order_residuals(method, order).back();
    if (what == "embedded order") {
      method.b = vector("b_hat", values);
      return order_residuals(method, order).back();
    }
    // The coefficients of theta^m in sum_i b_i(theta) Phi_i(t) = theta^order / gamma(t).
    const Matrix<S> weights = matrix("b_theta", values);
    std::vector<S> all;
    for (Index m = 0; m < std::max<Index>(weights.cols(), order); ++m) {
      method.b = m < weights.cols() ? Vector<S>(weights.col(m)) : Vector<S>(Vector<S>::Zero(weights.rows()));
      const std::vector<S> residuals = order_residuals(method, order).back();
      for (const S& residual : residuals) all.push_back(m + 1 == order ? residual : S(residual + 1));
    }
    return all;
  }

  template <class S>
  std::vector<S> consistency_in(const std::vector<S>& values) const {
    if (!has("c")) return {};
    const Matrix<S> A = matrix("A", values);
    const Vector<S> c = vector("c", values);
    std::vector<S> off;
    for (Index i = 0; i < c.size(); ++i) {
      S sum = -c[i];
      for (Index j = 0; j < A.cols(); ++j) sum += A(i, j);
      off.push_back(sum);
    }
    return off;
  }
};

}  // namespace

SchemePtr runge_kutta_scheme(const SchemeText& text) { return std::make_shared<const RungeKuttaScheme>(text); }

}  // namespace hbvm::core

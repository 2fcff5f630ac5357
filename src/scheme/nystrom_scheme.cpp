#include "scheme/families.hpp"
#include "scheme/nystrom_trees.hpp"

namespace hbvm::core {
namespace {

constexpr int highest_of_nystrom = 12, highest_with_velocity = 9;

/// K_i = f(q + c_i h v + h^2 sum_j A_ij K_j, v + h sum_j A_hat_ij K_j).
/// q_1 = q + h v + h^2 sum_i b_i K_i. v_1 = v + h sum_i b_hat_i K_i. Without A_hat the force is f(q).
class NystromScheme final : public SchemeByTemplate<NystromScheme> {
 public:
  explicit NystromScheme(const SchemeText& text) {
    const std::size_t s = row_length(text, "b");
    take(text, "c", 1, s);
    take(text, "A", s, s);
    take(text, "b", 1, s);
    take(text, "b_hat", 1, s);
    const bool with_velocity = text.arrays.contains("A_hat");
    if (with_velocity) take(text, "A_hat", s, s);
    add_part(text, "order", "order", with_velocity ? highest_with_velocity : highest_of_nystrom);
  }

  std::string family() const override { return "nystrom"; }

  template <class S>
  std::vector<S> residuals_in(std::size_t, int order, const std::vector<S>& values) const {
    const Matrix<S> A = matrix("A", values), A_hat = has("A_hat") ? matrix("A_hat", values) : Matrix<S>();
    return nystrom_residuals(
        NystromCoefficients<S>{vector("c", values), vector("b", values), vector("b_hat", values), A, A_hat}, order);
  }
  /// The nodes are where the velocity's stages are.
  template <class S>
  std::vector<S> consistency_in(const std::vector<S>& values) const {
    std::vector<S> off;
    if (!has("A_hat")) return off;
    const Matrix<S> A_hat = matrix("A_hat", values);
    const Vector<S> c = vector("c", values);
    for (Index i = 0; i < c.size(); ++i) off.push_back(S(A_hat.row(i).sum() - c[i]));
    return off;
  }
};

}  // namespace

SchemePtr nystrom_scheme(const SchemeText& text) { return std::make_shared<const NystromScheme>(text); }

}  // namespace hbvm::core

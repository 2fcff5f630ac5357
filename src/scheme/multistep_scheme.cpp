#include "hbvm/error.hpp"
#include "scheme/families.hpp"

namespace hbvm::core {
namespace {

constexpr int highest_of_multistep = 30;

/// sum_j alpha_j y_(n+j) = h sum_j beta_j f_(n+j), j = 0 .. k. Of order p if sum_j alpha_j j^q = q sum_j beta_j j^(q-1)
/// for q = 1 .. p, and sum_j alpha_j = 0.
class MultistepScheme final : public SchemeByTemplate<MultistepScheme> {
 public:
  explicit MultistepScheme(const SchemeText& text) {
    const std::size_t k = row_length(text, "alpha");
    if (k < 2) throw InputError(text.file + ": alpha has one number; a method over k steps has k + 1");
    take(text, "alpha", 1, k);
    take(text, "beta", 1, k);
    add_part(text, "order", "order", std::min(highest_of_multistep, 2 * static_cast<int>(k)));
  }

  std::string family() const override { return "multistep"; }

  template <class S>
  std::vector<S> residuals_in(std::size_t, int order, const std::vector<S>& values) const {
    const Vector<S> alpha = vector("alpha", values), beta = vector("beta", values);
    S off = 0, size = 0;
    for (Index j = 0; j < alpha.size(); ++j) {
      S power = 1;  // j^(q-1)
      for (int n = 1; n < order; ++n) power *= S(static_cast<long>(j));
      const S left = alpha[j] * power * S(static_cast<long>(j)), right = S(order) * beta[j] * power;
      off += left - right;
      size += magnitude(left) + magnitude(right);
    }
    return {size == 0 ? S(1) : S(off / size)};
  }
  template <class S>
  std::vector<S> consistency_in(const std::vector<S>& values) const {
    return {vector("alpha", values).sum()};
  }
};

}  // namespace

SchemePtr multistep_scheme(const SchemeText& text) { return std::make_shared<const MultistepScheme>(text); }

}  // namespace hbvm::core

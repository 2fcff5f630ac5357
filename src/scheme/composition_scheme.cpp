#include "hbvm/error.hpp"
#include "scheme/families.hpp"
#include "scheme/word_series.hpp"

namespace hbvm::core {
namespace {

constexpr int highest_of_composition = 14;

/// Steps gamma_i h of a symmetric method of order 2, exp(h Y_1 + h^3 Y_3 + h^5 Y_5 ...). Or steps of a method,
/// exp(h Y_1 + h^2 Y_2 + ...), by alpha_i h, and of its adjoint, exp(h Y_1 - h^2 Y_2 + ...), by beta_i h before it.
class CompositionScheme final : public SchemeByTemplate<CompositionScheme> {
 public:
  explicit CompositionScheme(const SchemeText& text) {
    if (text.arrays.contains("gamma")) {
      take(text, "gamma", 1, row_length(text, "gamma"));
    } else {
      const std::size_t s = row_length(text, "alpha");
      take(text, "alpha", 1, s);
      take(text, "beta", 1, s);
    }
    add_part(text, "order", "order", highest_of_composition);
  }

  std::string family() const override { return "composition"; }

  template <class S>
  std::vector<S> residuals_in(std::size_t, int order, const std::vector<S>& values) const {
    std::vector<int> weights;
    for (int w = 1; w <= order; w += has("gamma") ? 2 : 1) weights.push_back(w);
    const Words& words = words_up_to(weights, order);
    WordSeries<S> series = exponential<S>(words, std::vector<S>(weights.size(), S(0)));
    const auto step = [&](const S& x, bool adjoint) {
      std::vector<S> coefficients;
      S power = 1;
      int w = 0;
      for (const int weight : weights) {
        for (; w < weight; ++w) power *= x;
        coefficients.push_back(adjoint && weight % 2 == 0 ? S(-power) : power);
      }
      series = product(words, series, exponential<S>(words, coefficients));
    };
    if (has("gamma")) {
      const Vector<S> gamma = vector("gamma", values);
      for (Index i = 0; i < gamma.size(); ++i) step(gamma[i], false);
    } else {
      const Vector<S> alpha = vector("alpha", values), beta = vector("beta", values);
      for (Index i = 0; i < alpha.size(); ++i) {
        step(beta[i], true);
        step(alpha[i], false);
      }
    }
    std::vector<S> one(weights.size(), S(0));
    one[0] = 1;
    return lyndon_residuals(words, series, exponential<S>(words, one), order);
  }
  template <class S>
  std::vector<S> consistency_in(const std::vector<S>&) const {
    return {};
  }
};

}  // namespace

SchemePtr composition_scheme(const SchemeText& text) { return std::make_shared<const CompositionScheme>(text); }

}  // namespace hbvm::core

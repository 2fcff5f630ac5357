#include "hbvm/error.hpp"
#include "scheme/families.hpp"
#include "scheme/nystrom_trees.hpp"
#include "scheme/word_series.hpp"

namespace hbvm::core {
namespace {

constexpr int highest_of_splitting = 12;

/// The product exp(a_1 h X) exp(b_1 h Y) exp(a_2 h X) ... in that order. With one a more than b it ends as it began;
/// with one b more it begins with b. X is the drift, q' = v, and Y the kick, v' = f(q).
class SplittingScheme final : public SchemeByTemplate<SplittingScheme> {
 public:
  explicit SplittingScheme(const SchemeText& text) {
    const std::size_t a = row_length(text, "a"), b = row_length(text, "b");
    if (a > b + 1 || b > a + 1)
      throw InputError(text.file + ": a has " + std::to_string(a) + " numbers and b " + std::to_string(b) +
                       "; they act in turn, so that one may have one more than the other");
    take(text, "a", 1, a);
    take(text, "b", 1, b);
    add_part(text, "order", "order", highest_of_splitting);
    add_part(text, "order of q'' = f(q)", "nystrom_order", highest_of_splitting);
  }

  std::string family() const override { return "splitting"; }

  template <class S>
  std::vector<S> residuals_in(std::size_t part, int order, const std::vector<S>& values) const {
    const Vector<S> a = vector("a", values), b = vector("b", values);
    return part == 0 ? of_any_flows(a, b, order) : of_accelerations(a, b, order);
  }
  template <class S>
  std::vector<S> consistency_in(const std::vector<S>&) const {
    return {};
  }

 private:
  template <class S, class F>
  static void in_turn(const Vector<S>& a, const Vector<S>& b, const F& use) {
    const bool b_first = b.size() > a.size();
    for (Index i = 0; i < std::max(a.size(), b.size()); ++i) {
      if (b_first && i < b.size()) use(false, b[i]);
      if (i < a.size()) use(true, a[i]);
      if (!b_first && i < b.size()) use(false, b[i]);
    }
  }

  template <class S>
  static std::vector<S> of_any_flows(const Vector<S>& a, const Vector<S>& b, int order) {
    const Words& words = words_up_to({1, 1}, order);
    WordSeries<S> series = exponential<S>(words, {S(0), S(0)});
    in_turn(a, b, [&](bool drift, const S& x) {
      series = product(words, series, exponential<S>(words, {drift ? x : S(0), drift ? S(0) : x}));
    });
    return lyndon_residuals(words, series, exponential<S>(words, {S(1), S(1)}), order);
  }

  /// Kicks are the stages of an explicit Nystrom method: K_j acts on all that is later.
  template <class S>
  static std::vector<S> of_accelerations(const Vector<S>& a, const Vector<S>& b, int order) {
    const Index s = b.size();
    NystromCoefficients<S> method{Vector<S>(s), Vector<S>(s), b, Matrix<S>::Zero(s, s), {}};
    S time = 0;
    Index kick = 0;
    in_turn(a, b, [&](bool drift, const S& x) {
      if (drift)
        time += x;
      else
        method.c[kick++] = time;
    });
    for (Index j = 0; j < s; ++j) {
      for (Index i = j + 1; i < s; ++i) method.A(i, j) = b[j] * (method.c[i] - method.c[j]);
      method.b[j] = b[j] * (time - method.c[j]);
    }
    std::vector<S> residuals = nystrom_residuals(method, order);
    if (order == 1) residuals.push_back(S(time - 1));
    return residuals;
  }
};

}  // namespace

SchemePtr splitting_scheme(const SchemeText& text) { return std::make_shared<const SplittingScheme>(text); }

}  // namespace hbvm::core

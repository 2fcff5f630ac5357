#pragma once

#include <string>
#include <utility>
#include <vector>

#include "linear/matrix.hpp"

namespace hbvm::core {

/// Words up to a weight in letters that do not commute, each with its weight: the terms of a product of exponentials of
/// vector fields. A word is a text of letters 'a', 'b', ...; the places of its beginnings and ends are known.
class Words {
 public:
  /// \param weights of the letters
  Words(const std::vector<int>& weights, int max_weight);

  struct Word {
    std::string letters;
    int weight = 0;
    /// All ways to part it: places of the beginning and of the rest.
    std::vector<std::pair<std::size_t, std::size_t>> parts;
    bool is_lyndon = false;  ///< smaller than each of its ends
  };
  const std::vector<Word>& all() const { return words_; }

 private:
  std::vector<Word> words_;
};

/// Those of the letters up to a weight; made once, for any thread.
const Words& words_up_to(const std::vector<int>& weights, int max_weight);

/// A series in words; exp of a sum of letters, or products of such.
template <class S>
using WordSeries = std::vector<S>;

/// The product of two series.
template <class S>
WordSeries<S> product(const Words& words, const WordSeries<S>& x, const WordSeries<S>& y) {
  WordSeries<S> result;
  for (const Words::Word& word : words.all()) {
    S sum = 0;
    for (const auto& [begin, end] : word.parts)
      if (x[begin] != 0 && y[end] != 0) sum += x[begin] * y[end];
    result.push_back(sum);
  }
  return result;
}

/// exp(sum of coefficient times letter), in which a coefficient may be 0.
template <class S>
WordSeries<S> exponential(const Words& words, const std::vector<S>& coefficients) {
  WordSeries<S> result;
  for (const Words::Word& word : words.all()) {
    S term = 1;
    int n = 0;
    for (const char letter : word.letters) {
      term *= coefficients[static_cast<std::size_t>(letter - 'a')];
      term /= S(++n);
    }
    result.push_back(term);
  }
  return result;
}

/// How far a product of exponentials is from exp(sum of the letters of `exact`) in the Lyndon words of one weight,
/// which decide it (M. Lothaire, Combinatorics on words): a coefficient over its value less 1, or what should be 0.
template <class S>
std::vector<S> lyndon_residuals(const Words& words, const WordSeries<S>& series, const WordSeries<S>& exact,
                                int weight) {
  std::vector<S> residuals;
  for (std::size_t w = 0; w < words.all().size(); ++w) {
    const Words::Word& word = words.all()[w];
    if (word.weight != weight || !word.is_lyndon) continue;
    S factorial = 1;
    for (std::size_t n = 2; n <= word.letters.size(); ++n) factorial *= S(static_cast<long>(n));
    residuals.push_back(S((series[w] - exact[w]) * factorial));
  }
  return residuals;
}

}  // namespace hbvm::core

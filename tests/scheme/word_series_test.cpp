#include "scheme/word_series.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace hbvm::core {
namespace {

std::vector<long> lyndon_words(const std::vector<int>& weights, int most) {
  std::vector<long> counts(static_cast<std::size_t>(most), 0);
  for (const Words::Word& word : words_up_to(weights, most).all())
    if (word.is_lyndon) ++counts[static_cast<std::size_t>(word.weight - 1)];
  return counts;
}

/// As many as dimensions of the free Lie algebra, by Witt's formula.
TEST(WordSeries, HaveAsManyConditionsAsBrackets) {
  EXPECT_EQ(lyndon_words({1, 1}, 10), (std::vector<long>{2, 1, 2, 3, 6, 9, 18, 30, 56, 99}));
  EXPECT_EQ(lyndon_words({1, 3, 5, 7, 9}, 9), (std::vector<long>{1, 0, 1, 1, 2, 2, 4, 5, 8}));
}

TEST(WordSeries, OfOneFieldCommute) {
  const Words& words = words_up_to({1}, 5);
  const WordSeries<double> whole = exponential<double>(words, {1.0}),
                           parts =
                               product(words, exponential<double>(words, {0.25}), exponential<double>(words, {0.75}));
  for (std::size_t w = 0; w < whole.size(); ++w) EXPECT_NEAR(whole[w], parts[w], 1e-15);
}

}  // namespace
}  // namespace hbvm::core

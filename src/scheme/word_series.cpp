#include "scheme/word_series.hpp"

#include <map>
#include <mutex>

namespace hbvm::core {
namespace {

bool is_lyndon(const std::string& word) {
  for (std::size_t n = 1; n < word.size(); ++n)
    if (word.compare(n, std::string::npos, word) <= 0) return false;
  return !word.empty();
}

}  // namespace

Words::Words(const std::vector<int>& weights, int max_weight) {
  std::map<std::string, std::size_t> places;
  words_.push_back({"", 0, {}, false});
  // By weight, and so that a word stands behind its beginnings.
  for (std::size_t w = 0; w < words_.size(); ++w)
    for (std::size_t letter = 0; letter < weights.size(); ++letter) {
      const Word& before = words_[w];
      if (before.weight + weights[letter] > max_weight) continue;
      const std::string letters = before.letters + static_cast<char>('a' + static_cast<char>(letter));
      words_.push_back({letters, before.weight + weights[letter], {}, is_lyndon(letters)});
    }
  for (std::size_t w = 0; w < words_.size(); ++w) places[words_[w].letters] = w;
  for (Word& word : words_)
    for (std::size_t n = 0; n <= word.letters.size(); ++n)
      word.parts.emplace_back(places.at(word.letters.substr(0, n)), places.at(word.letters.substr(n)));
}

const Words& words_up_to(const std::vector<int>& weights, int max_weight) {
  static std::mutex guard;
  static std::map<std::pair<std::vector<int>, int>, Words> known;
  const std::lock_guard lock(guard);
  const auto key = std::pair(weights, max_weight);
  const auto found = known.find(key);
  return found != known.end() ? found->second : known.emplace(key, Words(weights, max_weight)).first->second;
}

}  // namespace hbvm::core

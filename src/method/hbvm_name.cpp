#include "method/hbvm_name.hpp"

#include <algorithm>
#include <charconv>
#include <iterator>

#include "hbvm/error.hpp"

namespace hbvm::core {

std::string HbvmName::text() const {
  const std::string third = r == 0 ? "" : "," + std::to_string(r);
  return "hbvm:" + (is_auto() ? "auto" : std::to_string(k)) + "," + std::to_string(s) + third;
}

void HbvmName::check() const {
  if (s < 1) throw InputError("method " + text() + ": S must be at least 1");
  if (k != 0 && k < s) throw InputError("method " + text() + ": K must be at least S");
  if (s > max_s) throw InputError("method " + text() + ": S must be at most " + std::to_string(max_s));
  if (k > max_k) throw InputError("method " + text() + ": K must be at most " + std::to_string(max_k));
  if (r != 0 && r < s) throw InputError("method " + text() + ": R must be at least S");
  if (r > max_k) throw InputError("method " + text() + ": R must be at most " + std::to_string(max_k));
}

int exact_nodes(int degree, int s) {
  const long long nodes = std::max<long long>(s, (static_cast<long long>(degree) * s + 1) / 2);
  if (nodes > max_k)
    throw InputError("a polynomial of degree " + std::to_string(degree) + " along a curve of degree S = " +
                     std::to_string(s) + " takes " + std::to_string(nodes) + " nodes to be exact, more than " +
                     std::to_string(max_k) + ": take a smaller S, or name all of K, S, R as in hbvm:K,S,R");
  return static_cast<int>(nodes);
}

HbvmName HbvmName::parse(std::string_view text) {
  const InputError unknown("unknown method '" + std::string(text) +
                           "': use hbvm:K,S with whole numbers K >= S >= 1, e.g. hbvm:5,3, or hbvm:auto,S; a third, "
                           "hbvm:K,S,R with R >= S, is the number of nodes of constraints that are not quadratic");
  constexpr std::string_view prefix = "hbvm:", automatic = "auto";
  if (!text.starts_with(prefix)) throw unknown;
  HbvmName name;
  std::string_view rest = text.substr(prefix.size());
  const bool chosen_later = rest.starts_with(automatic);
  int* const numbers[] = {&name.k, &name.s, &name.r};
  std::size_t found = 0;
  if (chosen_later) {
    rest.remove_prefix(automatic.size());
    found = 1;
  }
  while (found == 0 || !rest.empty()) {
    if (found == std::size(numbers) || (found > 0 && rest.front() != ',')) throw unknown;
    if (found > 0) rest.remove_prefix(1);
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), *numbers[found]);
    if (error != std::errc()) throw unknown;
    rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
    ++found;
  }
  if (found < 2) throw unknown;
  if (!chosen_later && name.k < 1)
    throw InputError("method " + std::string(text) + ": K must be at least S, and S at least 1");
  if (found == std::size(numbers) && name.r < 1)
    throw InputError("method " + std::string(text) + ": R must be at least S");
  name.check();
  return name;
}

}  // namespace hbvm::core

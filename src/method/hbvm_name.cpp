#include "hbvm/method/hbvm_name.hpp"

#include <charconv>

#include "hbvm/error.hpp"

namespace hbvm {

void HbvmName::check() const {
  if (s < 1) throw InputError("method " + text() + ": S must be at least 1");
  if (k != 0 && k < s) throw InputError("method " + text() + ": K must be at least S");
  if (s > max_s) throw InputError("method " + text() + ": S must be at most " + std::to_string(max_s));
  if (k > max_k) throw InputError("method " + text() + ": K must be at most " + std::to_string(max_k));
}

HbvmName HbvmName::parse(std::string_view text) {
  constexpr std::string_view prefix = "hbvm:";
  HbvmName name;
  if (text.starts_with(prefix)) {
    const char* const end = text.data() + text.size();
    constexpr std::string_view automatic = "auto";
    auto first = std::from_chars(text.data() + prefix.size(), end, name.k);
    const bool chosen_later = text.substr(prefix.size()).starts_with(automatic);
    if (chosen_later) first = {text.data() + prefix.size() + automatic.size(), std::errc()};
    if (first.ec == std::errc() && first.ptr != end && *first.ptr == ',') {
      const auto second = std::from_chars(first.ptr + 1, end, name.s);
      if (second.ec == std::errc() && second.ptr == end) {
        if (!chosen_later && name.k < 1)
          throw InputError("method " + std::string(text) + ": K must be at least S, and S at least 1");
        name.check();
        return name;
      }
    }
  }
  throw InputError("unknown method '" + std::string(text) +
                   "': use hbvm:K,S with whole numbers K >= S >= 1, e.g. hbvm:5,3, or hbvm:auto,S");
}

}  // namespace hbvm

#include "hbvm/method/method_name.hpp"

#include <charconv>

#include "hbvm/error.hpp"

namespace hbvm {

void MethodName::check() const {
  if (s < 1) throw InputError("method " + text() + ": S must be at least 1");
  if (k < s) throw InputError("method " + text() + ": K must be at least S");
  if (k > max_stages) throw InputError("method " + text() + ": K must be at most " + std::to_string(max_stages));
}

MethodName MethodName::parse(std::string_view text) {
  constexpr std::string_view prefix = "hbvm:";
  MethodName name;
  if (text.starts_with(prefix)) {
    const char* const end = text.data() + text.size();
    const auto first = std::from_chars(text.data() + prefix.size(), end, name.k);
    if (first.ec == std::errc() && first.ptr != end && *first.ptr == ',') {
      const auto second = std::from_chars(first.ptr + 1, end, name.s);
      if (second.ec == std::errc() && second.ptr == end) {
        name.check();
        return name;
      }
    }
  }
  throw InputError("unknown method '" + std::string(text) + "': use hbvm:K,S with whole numbers K >= S >= 1, as hbvm:5,3");
}

}  // namespace hbvm

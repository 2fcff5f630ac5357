#pragma once

#include <string>
#include <string_view>

namespace hbvm {

inline constexpr int max_stages = 1'000;

/// A method as a user names it: "hbvm:K,S".
struct MethodName {
  int k = 0, s = 0;

  /// \throws InputError for another form, and unless 1 <= s <= k <= max_stages
  static MethodName parse(std::string_view text);
  /// \throws InputError unless 1 <= s <= k <= max_stages
  void check() const;
  std::string text() const { return "hbvm:" + std::to_string(k) + "," + std::to_string(s); }

  friend bool operator==(const MethodName&, const MethodName&) = default;
};

}  // namespace hbvm

#pragma once

#include <string>
#include <string_view>

namespace hbvm {

inline constexpr int max_k = 1'000;
inline constexpr int max_s = 200;

/// A method as a user names it: "hbvm:K,S", or "hbvm:auto,S", which leaves k to the scene and the precision: k = 0
/// until it is chosen.
struct HbvmName {
  int k = 0, s = 0;

  bool is_auto() const { return k == 0; }
  /// \throws InputError for another form, and unless 1 <= s <= k, s <= max_s and k <= max_k
  static HbvmName parse(std::string_view text);
  /// \throws InputError unless 1 <= s <= max_s and s <= k <= max_k, or k = 0
  void check() const;
  std::string text() const { return "hbvm:" + (is_auto() ? "auto" : std::to_string(k)) + "," + std::to_string(s); }

  friend bool operator==(const HbvmName&, const HbvmName&) = default;
};

}  // namespace hbvm

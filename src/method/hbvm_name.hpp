#pragma once

#include <string>
#include <string_view>

namespace hbvm::core {

inline constexpr int max_k = 1'000;
inline constexpr int max_s = 200;

/// A method as a user names it: "hbvm:K,S", or "hbvm:auto,S", which leaves k to the scene and the precision: k = 0
/// until it is chosen. A third number, "hbvm:K,S,R", is that of nodes for the constraints; r = 0 leaves it to the
/// constraints: s if all are quadratic.
struct HbvmName {
  int k = 0, s = 0, r = 0;

  bool is_auto() const { return k == 0; }
  /// \throws InputError for another form, and as check() does
  static HbvmName parse(std::string_view text);
  /// \throws InputError unless 1 <= s <= max_s, s <= k <= max_k or k = 0, and s <= r <= max_k or r = 0
  void check() const;
  std::string text() const;

  friend bool operator==(const HbvmName&, const HbvmName&) = default;
};

/// Gauss nodes that integrate a polynomial of a degree d exactly along a curve of degree s: d s / 2, and s at least.
/// \throws InputError if these are more than max_k
int exact_nodes(int degree, int s);

}  // namespace hbvm::core

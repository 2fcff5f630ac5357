#pragma once

#include <string>
#include <string_view>

namespace hbvm::core {

/// A working precision as a user names it: "double", "quad" or "mpfr:N", or "N" alone, with N decimal digits.
class Precision {
 public:
  enum class Kind { binary64, binary128, mpfr };
  static constexpr unsigned min_digits = 20;
  static constexpr unsigned max_digits = 10'000;

  /// \throws InputError unless `name` is one of these forms, min_digits <= N <= max_digits and this build has quad
  static Precision parse(std::string_view name);

  Kind kind() const { return kind_; }
  /// Decimal digits: 15, 33 or N.
  unsigned digits() const { return digits_; }
  std::string name() const;

  friend bool operator==(const Precision&, const Precision&) = default;

 private:
  Precision(Kind kind, unsigned digits) : kind_(kind), digits_(digits) {}
  Kind kind_;
  unsigned digits_;
};

/// The cheapest precision of 34 digits: "quad", or "mpfr:34" of a build without it.
const char* precision_of_34_digits();

}  // namespace hbvm::core

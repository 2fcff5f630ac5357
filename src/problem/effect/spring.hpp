#pragma once

#include <array>

#include "hbvm/error.hpp"
#include "problem/effect/interaction.hpp"

namespace hbvm::core {

/// A spring, linear for exponent 2: U = -stiffness/exponent |r - rest_length|^exponent, exponent >= 2. With rest_length
/// 0 and an even exponent U is a polynomial, and computed without a root. Its derivative is evaluated as it stands. It
/// is not finite where ends meet without an even exponent, or at the rest length if the exponent is not whole.
struct Spring {
  static constexpr std::string_view kind = "spring";
  static constexpr Acts acts = Acts::between_pairs;
  static constexpr bool needs_mass = false, needs_charge = false;
  static constexpr std::array<EffectKey, 3> keys{
      {{"stiffness"}, {"rest_length", false, "0"}, {"exponent", false, "2"}}};
  static constexpr Symmetry symmetry = Symmetry::central;
  static constexpr std::array<std::string_view, 1> factors{"stiffness"};

  template <class T>
  static T U(const Interaction<T>& pair) {
    return -(pair.number("stiffness") / pair.number("exponent") * stretch(pair));
  }

 private:
  /// |r - rest_length|^exponent.
  template <class T>
  static T stretch(const Interaction<T>& pair) {
    using std::abs, std::exp, std::log;
    const auto exponent = pair.whole("exponent");
    const long floor = pair.floor("exponent");
    if (floor < 2 || floor > 1000 || (floor == 1000 && !exponent))
      throw InputError("'exponent' must be from 2 to 1000");
    if (exponent && *exponent % 2 == 0) {
      if (pair.whole("rest_length") == 0) return power(pair.squared_distance(), *exponent / 2);
      return power(T(pair.distance() - pair.number("rest_length")), *exponent);
    }
    const T length =
        pair.whole("rest_length") == 0 ? pair.distance() : T(abs(pair.distance() - pair.number("rest_length")));
    if (exponent) return power(length, *exponent);
    return exp(pair.number("exponent") * log(length));
  }
};

}  // namespace hbvm::core

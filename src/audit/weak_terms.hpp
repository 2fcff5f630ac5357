#pragma once

#include <algorithm>

#include "problem/effect/term.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {

/// Digits in which terms of different degrees are told apart: what is weaker than the rest by more is not seen.
inline constexpr unsigned digits_of_terms = 1'000;

/// How weak what a method does not integrate exactly can be beside the rest of U, or of g. The recorded programs are
/// expanded in a Taylor series along lines near the start. Their directions are of all coordinates at once and of each
/// by itself. The terms of a degree above `exact_degree` are not integrated exactly.
class WeakTerms {
 public:
  /// In the digits of the scope. \param log2_scale of the motion's time scale
  WeakTerms(const Assembled<Mpfr>& scene, int log2_scale, int exact_degree);

  /// log2 of the greatest term of all over the greatest one that is not integrated exactly. The latter is of the body,
  /// pair or group and of the direction where it is the least. The value is 0 where there are none.
  struct Bits {
    double told = 0;  ///< of terms above rounding
    double all = 0;   ///< of those, too, that may be nothing but rounding
  };
  Bits of_U() const { return of_U_.bits(); }
  /// The same of each g by itself, the greatest.
  Bits of_g() const { return of_g_; }

 private:
  struct ErrorSizes {
    double greatest, least, least_of_all;
    ErrorSizes();
    Bits bits() const { return {std::max(greatest - least, double{0}), std::max(greatest - least_of_all, double{0})}; }
  };
  void expand(const EffectTerm<Mpfr>& term, Index instance, ErrorSizes& sizes);

  const Assembled<Mpfr>& scene_;
  int exact_degree_;
  std::vector<Vector<Mpfr>> places_, directions_;  ///< of all coordinates
  Mpfr size_ = 0;                                  ///< of a direction
  ErrorSizes of_U_;
  Bits of_g_;
};

}  // namespace hbvm::core

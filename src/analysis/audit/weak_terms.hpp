#pragma once

#include "hbvm/problem/effect/term.hpp"
#include "hbvm/scene/assemble.hpp"

namespace hbvm {

/// Digits in which terms of different degrees are told apart: what is weaker than the rest by more is not seen.
inline constexpr unsigned digits_of_terms = 1'000;

/// How weak what a method does not integrate exactly can be beside the rest of U, or of g. The recorded programs are
/// expanded in a Taylor series along lines near the start: in directions of all coordinates at once and of each by
/// itself. The terms of a degree above `exact_degree` are not integrated exactly.
class WeakTerms {
 public:
  /// In the digits of the scope. \param log2_scale of the motion's time scale
  WeakTerms(const Assembled<Mpfr>& scene, int log2_scale, int exact_degree);

  /// log2 of the greatest term of all over the greatest of those of the body, pair or group and of the direction where
  /// that is the least; 0 where there are none.
  double bits_of_U() const { return of_U_.bits(); }
  /// The same of each g by itself, the greatest.
  double bits_of_g() const { return bits_of_g_; }
  /// Whether some terms may be nothing but rounding.
  bool may_hide() const { return may_hide_; }

 private:
  struct Sizes {
    double greatest, least;
    Sizes();
    double bits() const { return greatest > least ? greatest - least : 0; }
  };
  void expand(const EffectTerm<Mpfr>& term, Index instance, Sizes& sizes);

  const Assembled<Mpfr>& scene_;
  int exact_degree_;
  std::vector<Vector<Mpfr>> places_, directions_;  ///< of all coordinates
  Mpfr size_ = 0;                                  ///< of a direction
  Sizes of_U_;
  double bits_of_g_ = 0;
  bool may_hide_ = false;
};

}  // namespace hbvm

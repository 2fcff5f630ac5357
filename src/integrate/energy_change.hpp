#pragma once

#include <map>

#include "integrate/observer.hpp"

namespace hbvm::core {

/// Whether a motion still has the energy it began with. An error of H is compared with the kinetic energy T. That is T
/// at its own mesh point or T as half of the mesh points have it, whichever is more. T does not depend on where a
/// potential is 0. A pericentre, where T is a thousand times what it is elsewhere, does not hide an error that lasts. A
/// turning point, where T is 0, makes none.
template <Scalar S>
class EnergyChange {
 public:
  /// The energy has changed where H is off by more than 1/20 of that. By then some digit of speeds and periods is all
  /// that is left. Methods that let H swing within their error stay below it at steps that resolve the motion.
  static constexpr int part = 20;

  /// A mesh point: T and H - H_0 there.
  void observe(const S& kinetic, const S& error, const S& t);
  void remember(Archive& archive);

  /// Where it changed: the greatest error there, the median kinetic energy of the mesh points to a factor of 2, and the
  /// first time. The error is 0 if nowhere.
  struct Change {
    S error = 0, usual = 0, t = 0;
  };
  Change change() const;

 private:
  /// What lies in 2^(exponent - 1) .. 2^exponent: how many T, and the first of the errors that exceed 1/20 of their T.
  struct Bin {
    long count = 0;
    bool reached = false;
    S first = 0;
  };
  S usual() const;

  std::map<long, Bin> bins_;  ///< by exponent
  S error_ = 0, t_ = 0, part_ = part, scaled_;
};

}  // namespace hbvm::core

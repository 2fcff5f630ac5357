#pragma once

#include "reference/closed_form/recognition.hpp"

namespace hbvm::core {

/// A scene in space all of which moves like one rigid body. Its coordinates may be points joined by rods, or a
/// reference point and directors. Every constraint is kept by all rotations (about the pivot, if a point is held).
/// There are so many that no other motion is left. The mass matrix consists of multiples of the 3 x 3 identity.
struct RigidShape {
  /// The coordinates, three by three: those of a point, which translate with the body, and those of a director.
  struct Block {
    Index offset;
    bool translates;
    Vector<Mpfr> arm;  ///< at the start, from the middle if it translates
  };
  std::vector<Block> blocks;
  bool pivoted = false;
  Mpfr mass;             ///< of what translates
  Vector<Mpfr> middle;   ///< at the start: the pivot, or else the centre of mass
  Vector<Mpfr> drift;    ///< velocity of the middle
  Vector<Mpfr> angular;  ///< angular momentum about the middle
  Mpfr moments[3];       ///< principal moments of inertia about the middle, ascending
  Matrix<Mpfr> axes;     ///< principal axes at the start, as columns, right-handed

  /// What differs by rounding alone counts as equal. The shape is none if it has no extent across some axis.
  static std::optional<RigidShape> of(const Recognition& content);

  /// q and v of all coordinates: each arm turned by R, with the angular velocity omega in space.
  void place(const Matrix<Mpfr>& R, const Vector<Mpfr>& omega, const Vector<Mpfr>& middle_now,
             const Vector<Mpfr>& drift_now, Vector<Mpfr>& q, Vector<Mpfr>& v) const;
};

}  // namespace hbvm::core

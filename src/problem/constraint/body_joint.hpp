#pragma once

#include <string>
#include <utility>
#include <vector>

#include "problem/constraint/axis.hpp"
#include "problem/constraint/common_point.hpp"
#include "problem/constraint/displacement_product.hpp"

namespace hbvm::core {

/// A joint of two rigid bodies, or of one and space, by what it holds: the g that it is made of. The points that it is
/// between are q_a of the first and q_b of the second.
template <Scalar S>
class BodyJoint {
 public:
  using Parts = ConstraintParts<CommonPoint<S>, DisplacementProduct<S>>;

  explicit BodyJoint(const ConstraintInput<S>& input)
      : dimension_(input.dimension), x_(input.pair("between")), frames_(input.frames.find("between")->second) {}

  const Frame<S>& first() const { return frames_[0]; }
  const Frame<S>& second() const { return frames_[1]; }

  /// q_a = q_b. Nothing is left to hold where both are fixed in space already.
  BodyJoint& holds_the_point() {
    if (!x_.blocks.empty())
      for (auto& [name, form] : CommonPoint<S>::of(x_, dimension_)) parts_.push_back({name, std::get<0>(form)});
    else if (x_.shift.size() > 0)
      throw InputError("its points are fixed in space, and apart");
    return *this;
  }

  /// (q_a - q_b).e = 0 for all e across an axis of one of the frames.
  BodyJoint& slides_along(const Frame<S>& frame, const Vector<S>& axis) {
    if (x_.blocks.empty()) throw InputError("its points are fixed in space, where nothing slides");
    add_products("across", x_, frame, axis);
    return *this;
  }

  /// A direction of the first body is n.e = 0 and n.f = 0 away from the axis of the second. These are two independent
  /// g, whose multipliers are torques, where parallel vectors would be three dependent ones.
  BodyJoint& turns_about(const Vector<S>& axis, const Vector<S>& second_axis) {
    add_products("axis", first().direction(axis), second(), second_axis);
    return *this;
  }

  /// The second body stands to the first as at the start. The directors of the second are b, and w is fixed in the
  /// first where they are then. So w1.b2 = 0, and in space also w2.b3 = 0 and w3.b1 = 0.
  BodyJoint& holds_the_orientation() {
    const Matrix<S> a = orthonormal(first()), b = orthonormal(second());
    const std::vector<Index> turns = dimension_ == 2 ? std::vector<Index>{2} : std::vector<Index>{0, 1, 2};
    for (const Index turn : turns) {
      const Index j = (turn + 1) % 3, k = (turn + 2) % 3;
      const Vector<S> w = without_round_off(a * b.row(j).transpose());
      parts_.push_back(
          {dimension_ == 2 ? "turn" : "turn, " + std::to_string(turn + 1),
           DisplacementProduct<S>{first().direction(w), second().direction(Vector<S>::Unit(dimension_, k)), S(0)}});
    }
    return *this;
  }

  /// n.m = 0 for a direction of each.
  BodyJoint& crosses(const Vector<S>& axis, const Vector<S>& second_axis) {
    parts_.push_back({"axes", DisplacementProduct<S>{first().direction(axis), second().direction(second_axis), S(0)}});
    return *this;
  }

  Parts parts() && { return std::move(parts_); }

  /// Where the axes of a frame stand at the start, a row each, orthonormal to the last digit.
  static Matrix<S> orthonormal(const Frame<S>& frame) {
    frame.direction(Vector<S>::Zero(frame.start.rows()));
    Matrix<S> axes = frame.start;
    for (Index i = 0; i < axes.rows(); ++i) {
      Vector<S> row = axes.row(i).transpose();
      for (Index j = 0; j < i; ++j) {
        S product = 0;
        for (Index l = 0; l < row.size(); ++l) product += axes(j, l) * row[l];
        row -= product * axes.row(j).transpose();
      }
      axes.row(i) = unit_axis(row, "directors").transpose();
    }
    return axes;
  }

 private:
  void add_products(const std::string& name, const Displacement<S>& x, const Frame<S>& frame, const Vector<S>& axis) {
    const std::vector<Vector<S>> all = across(axis);
    for (std::size_t i = 0; i < all.size(); ++i)
      parts_.push_back({all.size() == 1 ? name : name + ", " + std::to_string(i + 1),
                        DisplacementProduct<S>{x, frame.direction(all[i]), S(0)}});
  }

  /// The components of a unit vector, without what rounding makes of 0.
  static Vector<S> without_round_off(Vector<S> v) {
    for (Index i = 0; i < v.size(); ++i)
      if (magnitude(v[i]) <= S(16) * epsilon<S>()) v[i] = 0;
    return v;
  }

  Index dimension_;
  const Displacement<S>& x_;
  const std::array<Frame<S>, 2>& frames_;
  Parts parts_;
};

}  // namespace hbvm::core

#include "reference/closed_form/rigid_shape.hpp"

#include <algorithm>
#include <variant>

#include "reference/closed_form/symmetric_eigen.hpp"

namespace hbvm::core {
namespace {

constexpr Index space = 3;
/// Roundings that principal moments come from.
constexpr int units = 64;

/// The displacements that a constraint depends on by their products alone; none if it is another constraint.
std::optional<std::vector<const Displacement<Mpfr>*>> displacements(const ConstraintForms<Mpfr>& form) {
  if (const auto* rod = std::get_if<Rod<Mpfr>>(&form)) return std::vector{&rod->x};
  if (const auto* angle = std::get_if<DisplacementProduct<Mpfr>>(&form)) return std::vector{&angle->x, &angle->y};
  return std::nullopt;
}

/// Finds where the scene is held: false if not all displacements turn about one point.
class Pivot {
 public:
  explicit Pivot(const RigidShape& shape) : shape_(shape) {}

  bool takes(const Displacement<Mpfr>& x) {
    Mpfr weight = 0;
    for (const auto& block : x.blocks) {
      const auto place = std::find_if(shape_.blocks.begin(), shape_.blocks.end(),
                                      [&](const RigidShape::Block& b) { return b.offset == block.offset; });
      if (place == shape_.blocks.end()) return false;
      if (place->translates) weight += block.weight;
    }
    const Vector<Mpfr> shift = x.shift.size() > 0 ? x.shift : Vector<Mpfr>::Zero(space);
    if (weight == 0) return max_norm(shift) == 0;
    const Vector<Mpfr> here = shift / -weight;
    if (point && max_norm(Vector<Mpfr>(here - *point)) > 0) return false;
    point = here;
    return true;
  }
  std::optional<Vector<Mpfr>> point;

 private:
  const RigidShape& shape_;
};

}  // namespace

std::optional<RigidShape> RigidShape::of(const Recognition& content) {
  const Problem<Mpfr>& problem = content.scene.problem;
  if (content.dimension != space || problem.nu() == 0) return std::nullopt;
  RigidShape shape;
  bool translates = false;
  for (const SpaceBlock& block : problem.blocks) {
    shape.blocks.push_back({block.offset, block.translates, content.scene.q0.segment(block.offset, space)});
    translates = translates || block.translates;
  }
  Pivot pivot(shape);
  for (const Constraint<Mpfr>& constraint : problem.constraints) {
    const auto found = displacements(constraint.form);
    if (!found) return std::nullopt;
    for (const Displacement<Mpfr>* x : *found)
      if (!pivot.takes(*x)) return std::nullopt;
  }
  shape.pivoted = !translates || pivot.point;
  // Of all motions those of a rigid body are left.
  if (problem.m() - problem.nu() != (shape.pivoted ? 3 : 6)) return std::nullopt;

  // The mass matrix by blocks.
  const auto n = static_cast<Index>(shape.blocks.size());
  Matrix<Mpfr> mass = Matrix<Mpfr>::Zero(problem.m(), problem.m()), mu(n, n);
  for (const auto& block : problem.mass.blocks())
    for (Index i = 0; i < block.size; ++i)
      for (Index j = 0; j < block.size; ++j)
        mass(block.offset + i, block.offset + j) = block.full ? block.M(i, j) : i == j ? block.mass : Mpfr(0);
  for (Index k = 0; k < n; ++k)
    for (Index l = 0; l < n; ++l) {
      const Index row = shape.blocks[static_cast<std::size_t>(k)].offset,
                  column = shape.blocks[static_cast<std::size_t>(l)].offset;
      mu(k, l) = mass(row, column);
      for (Index i = 0; i < space; ++i)
        for (Index j = 0; j < space; ++j)
          if (mass(row + i, column + j) != (i == j ? mu(k, l) : Mpfr(0))) return std::nullopt;
    }

  shape.mass = 0;
  shape.middle = shape.drift = shape.angular = Vector<Mpfr>::Zero(space);
  for (Index k = 0; k < n; ++k) {
    const Block& block = shape.blocks[static_cast<std::size_t>(k)];
    if (!block.translates) continue;
    shape.drift += content.scene.p0.segment(block.offset, space);
    for (Index l = 0; l < n; ++l) {
      const Block& other = shape.blocks[static_cast<std::size_t>(l)];
      shape.middle += mu(k, l) * other.arm;
      if (other.translates) shape.mass += mu(k, l);
    }
  }
  if (shape.pivoted) {
    shape.middle = pivot.point.value_or(Vector<Mpfr>::Zero(space));
    shape.drift = Vector<Mpfr>::Zero(space);
  } else {
    shape.middle /= shape.mass;
    shape.drift /= shape.mass;
  }
  Matrix<Mpfr> inertia = Matrix<Mpfr>::Zero(space, space);
  for (Block& block : shape.blocks) {
    if (block.translates) block.arm -= shape.middle;
    shape.angular += cross(block.arm, content.scene.p0.segment(block.offset, space));
  }
  for (Index k = 0; k < n; ++k)
    for (Index l = 0; l < n; ++l) {
      const Vector<Mpfr>&a = shape.blocks[static_cast<std::size_t>(k)].arm,
            &b = shape.blocks[static_cast<std::size_t>(l)].arm;
      const Mpfr product = inner(a, b);
      for (Index i = 0; i < space; ++i) {
        inertia(i, i) += mu(k, l) * product;
        for (Index j = 0; j < space; ++j) inertia(i, j) -= mu(k, l) * (a[i] * b[j] + a[j] * b[i]) / 2;
      }
    }
  const SymmetricEigen eigen(inertia);
  std::vector<Index> order{0, 1, 2};
  std::sort(order.begin(), order.end(), [&](Index i, Index j) { return eigen.values[i] < eigen.values[j]; });
  shape.axes = Matrix<Mpfr>(space, space);
  for (Index i = 0; i < space; ++i) {
    shape.moments[i] = eigen.values[order[static_cast<std::size_t>(i)]];
    shape.axes.col(i) = eigen.vectors.col(order[static_cast<std::size_t>(i)]);
  }
  shape.axes.col(2) = cross(shape.axes.col(0), shape.axes.col(1));
  const Mpfr rounding = units * content.round_off * shape.moments[2];
  if (!(shape.moments[0] > rounding)) return std::nullopt;
  if (shape.moments[1] - shape.moments[0] <= rounding) shape.moments[1] = shape.moments[0];
  if (shape.moments[2] - shape.moments[1] <= rounding) shape.moments[2] = shape.moments[1];
  return shape;
}

void RigidShape::place(const Matrix<Mpfr>& R, const Vector<Mpfr>& omega, const Vector<Mpfr>& middle_now,
                       const Vector<Mpfr>& drift_now, Vector<Mpfr>& q, Vector<Mpfr>& v) const {
  for (const Block& block : blocks) {
    Vector<Mpfr> arm = multiplied(R, block.arm), rate = cross(omega, arm);
    if (block.translates) {
      arm += middle_now;
      rate += drift_now;
    }
    q.segment(block.offset, space) = arm;
    v.segment(block.offset, space) = rate;
  }
}

}  // namespace hbvm::core

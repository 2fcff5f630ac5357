#include "reference/closed_form/cubic_motion.hpp"
#include "reference/closed_form/rigid_shape.hpp"

namespace hbvm::core {
namespace {

/// Lagrange's top (Whittaker, Analytical Dynamics, 71). It is held at a point of its axis, with I_1 = I_2. A constant
/// force has the moment W in the distance of the axis' unit vector. Let z be the height of that vector, h the angular
/// momentum about the vertical and c that about the axis. With the energy E without c^2/(2 I_3),
///
///     z'^2 = 2/I_1 (E - W z)(1 - z^2) - (h - c z)^2/I_1^2,
///
/// which CubicMotion solves. The axis turns about the vertical by phi' = (h - c z)/(I_1 (1 - z^2)), the body about its
/// axis by psi' = c/I_3 - z phi'. Both are sums of 1/(1 - z) and 1/(1 + z).
class SymmetricTop : public ClosedForm {
 public:
  /// `axis` at the start; `up` against the force.
  SymmetricTop(const Recognition& content, RigidShape shape, const Vector<Mpfr>& up, const Vector<Mpfr>& axis,
               const Mpfr& across, const Mpfr& along, const Mpfr& W)
      : ClosedForm(content.scene.problem), shape_(std::move(shape)), up_(up), across_(across), along_(along) {
    const Vector<Mpfr>& L = shape_.angular;
    h_ = inner(L, up);
    c_ = inner(L, axis);
    const Mpfr z = inner(axis, up), f = 2 * W / across, square = across * across * f;
    const Vector<Mpfr> tilting = L - c_ * axis;
    const Mpfr e = (inner(tilting, tilting) / (2 * across) + W * z) / W;
    const Vector<Mpfr> omega = tilting / across;  // what turns the axis
    motion_.emplace(
        CubicRoots::of(Mpfr(-e - c_ * c_ / square), Mpfr(2 * h_ * c_ / square - 1), Mpfr(e - h_ * h_ / square)), f, z,
        inner(cross(omega, axis), up));
    // Across the vertical, first above the axis; and what of the body lies there, across the axis.
    first_ = axis - z * up;
    first_ /= norm(first_);
    second_ = cross(up, first_);
    body_ = frame(axis, second_);
  }
  std::string name() const override { return "symmetric heavy top (elliptic integrals)"; }

  /// Whether its axis comes to the vertical, where the angles of the formulas have no meaning.
  static bool may_stand_upright(const Mpfr& h, const Mpfr& c, const Mpfr& rounding) {
    return magnitude(Mpfr(h - c)) <= rounding || magnitude(Mpfr(h + c)) <= rounding;
  }

 private:
  /// Unit columns: x cross axis, x and the axis, for a unit vector x across it.
  static Matrix<Mpfr> frame(const Vector<Mpfr>& axis, const Vector<Mpfr>& x) {
    Matrix<Mpfr> result(3, 3);
    result.col(0) = cross(x, axis);
    result.col(1) = x;
    result.col(2) = axis;
    return result;
  }

  State state(const Mpfr& t) const override {
    const CubicMotion::Place now = motion_->at(t);
    const CubicMotion::Integrals integrals = motion_->integrals(t);
    const Mpfr from_below = (h_ - c_) / 2 * integrals.below, from_above = (h_ + c_) / 2 * integrals.above;
    const Mpfr phi = (from_below + from_above) / across_,
               psi = t * (c_ / along_ - c_ / across_) - (from_below - from_above) / across_;
    const Vector<Mpfr> outwards = cos(phi) * first_ + sin(phi) * second_,
                       level = cos(phi) * second_ - sin(phi) * first_;
    const Mpfr radius = sqrt(Mpfr(now.above * now.below));
    const Vector<Mpfr> axis = radius * outwards + now.z * up_;
    Matrix<Mpfr> turned = frame(axis, level);
    const Vector<Mpfr> x = turned.col(0), y = turned.col(1);
    turned.col(0) = cos(psi) * x + sin(psi) * y;
    turned.col(1) = cos(psi) * y - sin(psi) * x;
    const Matrix<Mpfr> R = multiplied(turned, body_.transpose());
    // omega = axis x axis' + c/I_3 axis.
    const Mpfr square = now.above * now.below, turning = (h_ - c_ * now.z) / (across_ * square);
    const Vector<Mpfr> rate = -now.z * now.rate / radius * outwards + radius * turning * level + now.rate * up_;
    const Vector<Mpfr> omega = cross(axis, rate) + c_ / along_ * axis;
    State result{Vector<Mpfr>(problem().m()), Vector<Mpfr>(problem().m())};
    Vector<Mpfr> v(problem().m());
    shape_.place(R, omega, shape_.middle, shape_.drift, result.q, v);
    problem().mass.momentum(v, result.p);
    return result;
  }

  RigidShape shape_;
  Vector<Mpfr> up_, first_, second_;
  Mpfr across_, along_, h_, c_;
  Matrix<Mpfr> body_;
  std::optional<CubicMotion> motion_;
};

}  // namespace

std::unique_ptr<ClosedForm> symmetric_top_of(const Recognition& content) {
  if (!content.is_constant_force()) return nullptr;
  std::optional<RigidShape> shape = RigidShape::of(content);
  if (!shape || !shape->pivoted) return nullptr;
  const Mpfr* I = shape->moments;
  if (I[0] != I[1] && I[1] != I[2]) return nullptr;
  // The forces on all coordinates have one direction, and their moment is that of W along the axis.
  const Vector<Mpfr> force = content.constant_force();
  Vector<Mpfr> down = Vector<Mpfr>::Zero(3);
  for (const RigidShape::Block& block : shape->blocks) {
    const Vector<Mpfr> own = force.segment(block.offset, 3);
    if (norm(own) > norm(down)) down = own;
  }
  if (norm(down) == 0) return nullptr;
  down /= norm(down);
  constexpr int units = 64;
  Vector<Mpfr> lever = Vector<Mpfr>::Zero(3);
  Mpfr size = 0;
  for (const RigidShape::Block& block : shape->blocks) {
    const Vector<Mpfr> own = force.segment(block.offset, 3);
    const Mpfr along = inner(own, down);
    if (norm(Vector<Mpfr>(own - along * down)) > units * content.round_off * norm(own)) return nullptr;
    lever += along * block.arm;
    size += magnitude(along) * norm(block.arm);
  }
  const Mpfr W = norm(lever), rounding = units * content.round_off;
  if (W <= rounding * size) return nullptr;
  const Vector<Mpfr> axis = lever / W;
  // Of a body with three equal moments every axis is one.
  const bool sphere = I[0] == I[2];
  const Index figure = I[0] == I[1] ? 2 : 0;
  if (!sphere && norm(cross(axis, Vector<Mpfr>(shape->axes.col(figure)))) * W > rounding * size) return nullptr;
  const Mpfr across = I[1], along = I[figure];
  const Mpfr h = -inner(shape->angular, down), c = inner(shape->angular, axis);
  if (SymmetricTop::may_stand_upright(h, c, Mpfr(rounding * norm(shape->angular)))) return nullptr;
  return std::make_unique<SymmetricTop>(content, std::move(*shape), Vector<Mpfr>(-down), axis, across, along, W);
}

}  // namespace hbvm::core

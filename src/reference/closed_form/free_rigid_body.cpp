#include "reference/closed_form/elliptic.hpp"
#include "reference/closed_form/rigid_shape.hpp"

namespace hbvm::core {
namespace {

/// Euler's equations (Landau and Lifshitz, Mechanics, 37). The moments I_1, I_2, I_3 are in ascending order where L^2 >
/// 2 T I_2, else in descending order. With D = 2 T I_3 - L^2 the angular momentum is in the principal axes
///
///     L_1 = sqrt(I_1 D/(I_3 - I_1)) cn,  L_2 = sqrt(I_2 D/(I_3 - I_2)) sn,  L_3 = sqrt(I_3 (L^2 - 2 T I_1)/(I_3 -
///     I_1)) dn
///
/// of Omega t + u_0. The line of nodes, across L and the third axis, turns about L, which rests in space, by phi' = L
/// (2 T
/// - L_3^2/I_3)/(L^2 - L_3^2), so that
///
///     phi = L t/I_3 + L (I_3 - I_1)/(I_1 I_3) int dt/(1 - n sn^2),   n = -I_3 (I_2 - I_1)/(I_1 (I_3 - I_2))
///
/// and nothing is divided by D, which is 0 for a rotation about the third axis.
class FreeRigidBody : public ClosedForm {
 public:
  FreeRigidBody(const Recognition& content, RigidShape shape, const Vector<Mpfr>& acceleration)
      : ClosedForm(content.scene.problem), shape_(std::move(shape)), acceleration_(acceleration) {
    L_ = norm(shape_.angular);
    const Mpfr* I = shape_.moments;
    Vector<Mpfr> own = in_axes(shape_.angular);
    Mpfr twice_T = 0, side = 0;  // 2 T, and L^2 - 2 T I_2 without loss
    for (Index i = 0; i < 3; ++i) {
      twice_T += own[i] * own[i] / I[i];
      side += own[i] * own[i] * (I[i] - I[1]) / I[i];
    }
    // About a principal axis, the middle one too, where the formulas have the modulus 1 and no value.
    for (Index i = 0; i < 3; ++i)
      if (own[(i + 1) % 3] == 0 && own[(i + 2) % 3] == 0) steady_ = I[i];
    if (I[0] == I[2]) steady_ = I[0];
    if (steady_) return;
    if (side < 0 || I[1] == I[2]) {
      swap(shape_.moments[0], shape_.moments[2]);
      const Vector<Mpfr> first = shape_.axes.col(0);
      shape_.axes.col(0) = shape_.axes.col(2);
      shape_.axes.col(2) = -first;
      own = in_axes(shape_.angular);
    }
    if (own[2] < 0) {
      shape_.axes.col(1) *= Mpfr(-1);
      shape_.axes.col(2) *= Mpfr(-1);
      own = in_axes(shape_.angular);
    }
    // D and L^2 - 2 T I_1 as sums of one sign.
    const Mpfr D = own[0] * own[0] * (I[2] - I[0]) / I[0] + own[1] * own[1] * (I[2] - I[1]) / I[1],
               B = own[1] * own[1] * (I[1] - I[0]) / I[1] + own[2] * own[2] * (I[2] - I[0]) / I[2];
    first_ = sqrt(Mpfr(I[0] / (I[2] - I[0]) * D));
    second_ = sqrt(Mpfr(I[1] / (I[2] - I[1]) * D));
    third_ = sqrt(Mpfr(I[2] / (I[2] - I[0]) * B));
    ratio_ = sqrt(Mpfr(I[1] * (I[2] - I[0]) / ((I[2] - I[1]) * I[0])));
    m_ = I[0] == I[1] ? Mpfr(0) : Mpfr((I[1] - I[0]) * D / ((I[2] - I[1]) * B));
    m1_ = I[0] == I[1] ? Mpfr(1) : Mpfr((I[2] - I[0]) * side / ((I[2] - I[1]) * B));
    // Backwards in descending order.
    omega_ = sqrt(Mpfr((I[2] - I[1]) * B / (I[0] * I[1] * I[2]))) * (I[2] > I[0] ? 1 : -1);
    nodes_.emplace(Mpfr(-I[2] * (I[1] - I[0]) / (I[0] * (I[2] - I[1]))), Mpfr(ratio_ * ratio_), m1_);
    const Mpfr phi = atan2(own[1], Mpfr(ratio_ * own[0]));
    u0_ = elliptic_first(phi, m1_);
    nodes_before_ = nodes_->at(phi);
    // Where the line of nodes is at the start.
    const Matrix<Mpfr> start = triad(own, cos(phi), sin(phi));
    frame_ = multiplied(shape_.axes, start);
  }

  std::string name() const override {
    return steady_ ? "uniform rotation of a rigid body" : "free rigid body (Jacobi's functions, elliptic integrals)";
  }

 private:
  Vector<Mpfr> in_axes(const Vector<Mpfr>& x) const {
    Vector<Mpfr> result(3);
    for (Index i = 0; i < 3; ++i) result[i] = inner(Vector<Mpfr>(shape_.axes.col(i)), x);
    return result;
  }

  /// The line of nodes, what lies across it, and L, as unit columns in the principal axes.
  Matrix<Mpfr> triad(const Vector<Mpfr>& own, const Mpfr& cn, const Mpfr& sn) const {
    const Mpfr r = sqrt(Mpfr(cn * cn + ratio_ * ratio_ * sn * sn)), c = cn / r, s = ratio_ * sn / r, up = own[2] / L_,
               out = (c * own[0] + s * own[1]) / L_;
    Matrix<Mpfr> result(3, 3);
    result << -s, -up * c, out * c, c, -up * s, out * s, Mpfr(0), out, up;
    return result;
  }

  State state(const Mpfr& t) const override {
    Matrix<Mpfr> R(3, 3);
    Vector<Mpfr> omega = Vector<Mpfr>::Zero(3);
    if (steady_) {
      R = Matrix<Mpfr>::Identity(3, 3);
      if (L_ > 0) {
        const Vector<Mpfr> axis = shape_.angular / L_;
        omega = shape_.angular / *steady_;
        const Mpfr angle = t * L_ / *steady_, cosine = cos(angle), sine = sin(angle);
        for (Index j = 0; j < 3; ++j) {
          const Vector<Mpfr> unit = Vector<Mpfr>::Unit(3, j);
          R.col(j) = cosine * unit + sine * cross(axis, unit) + (1 - cosine) * axis[j] * axis;
        }
      }
    } else {
      const Mpfr* I = shape_.moments;
      const Mpfr u = u0_ + omega_ * t, phi = jacobi_amplitude(u, m_, m1_);
      const JacobiFunctions f = jacobi_functions(u, m_, m1_);
      Vector<Mpfr> own(3);
      own << first_ * f.cn, second_ * f.sn, third_ * f.dn;
      // A symmetric body has n = 0, and no Omega if it turns across its axis.
      const Mpfr excess = I[0] == I[1] ? Mpfr(0) : Mpfr((nodes_->at(phi) - nodes_before_) / omega_);
      const Mpfr angle = L_ * t / I[2] + L_ * (I[2] - I[0]) / (I[0] * I[2]) * (t + excess), cosine = cos(angle),
                 sine = sin(angle);
      Matrix<Mpfr> turned = frame_;
      turned.col(0) = cosine * frame_.col(0) + sine * frame_.col(1);
      turned.col(1) = cosine * frame_.col(1) - sine * frame_.col(0);
      const Matrix<Mpfr> axes_now = multiplied(turned, triad(own, f.cn, f.sn).transpose());
      R = multiplied(axes_now, shape_.axes.transpose());
      for (Index i = 0; i < 3; ++i) omega += own[i] / I[i] * axes_now.col(i);
    }
    State now{Vector<Mpfr>(problem().m()), Vector<Mpfr>(problem().m())};
    Vector<Mpfr> v(problem().m());
    shape_.place(R, omega, shape_.middle + t * shape_.drift + t * t / 2 * acceleration_,
                 shape_.drift + t * acceleration_, now.q, v);
    problem().mass.momentum(v, now.p);
    return now;
  }

  RigidShape shape_;
  Vector<Mpfr> acceleration_;
  std::optional<Mpfr> steady_;  ///< the moment about an axis that stays where it is
  Mpfr L_, first_, second_, third_, ratio_, m_, m1_, omega_, u0_, nodes_before_;
  std::optional<EllipticThird> nodes_;
  Matrix<Mpfr> frame_;
};

}  // namespace

std::unique_ptr<ClosedForm> free_rigid_body_of(const Recognition& content) {
  if (!content.is_constant_force()) return nullptr;
  std::optional<RigidShape> shape = RigidShape::of(content);
  if (!shape) return nullptr;
  // A field in which all falls alike: of the points only, with the acceleration of the centre of mass.
  const Vector<Mpfr> force = content.constant_force();
  Vector<Mpfr> acceleration = Vector<Mpfr>::Zero(3), all = Vector<Mpfr>::Zero(force.size());
  if (max_norm(force) > 0) {
    if (shape->pivoted) return nullptr;
    for (const RigidShape::Block& block : shape->blocks)
      if (block.translates) acceleration += force.segment(block.offset, 3) / shape->mass;
    for (const RigidShape::Block& block : shape->blocks)
      if (block.translates) all.segment(block.offset, 3) = acceleration;
    constexpr int units = 64;
    const Vector<Mpfr> expected = content.scene.problem.mass.momentum(all);
    if (distance(force, expected) > units * content.round_off * max_norm(force)) return nullptr;
  }
  return std::make_unique<FreeRigidBody>(content, std::move(*shape), acceleration);
}

}  // namespace hbvm::core

#pragma once

#include <array>

#include "integrate/observer.hpp"
#include "problem/constraint_gradient.hpp"

namespace hbvm::core {

/// The hidden constraints relative to the speed: for each constraint the greatest |grad g_a^T v| over the mesh, divided
/// by the greater of two speeds. The one is that of what it touches: the greatest sum over the bodies (or directors) of
/// |grad_i g_a| |v_i|. At most 1: the cosine of the angle at which the constraint is left. Masses do not enter, so that
/// a light body counts as much as a heavy one. The greatest speed over the path does, so that turning points do not.
///
/// The other is that of the mechanism. What the constraint touches may be at rest, as the bearing of a bar that turns
/// about it. There is no angle to speak of then. The bodies that it touches may move as fast as the fastest of those
/// that constraints join to them. The speed is what grad g_a^T v may then amount to. It is the sum over these bodies of
/// sqrt(grad_b g_a^T M_b^-1 grad_b g_a m_b) V. V is the greatest, over path and bodies, of sqrt(v_b^T M_b v_b / m_b).
/// That is the root of the mean square of the speeds of a body's matter. Of points it is the sum of |grad_b g_a| V.
template <Scalar S>
class HiddenCosines {
 public:
  /// The problem must outlive it; `steps` is the number of steps of the run.
  HiddenCosines(const Problem<S>& problem, long steps);

  /// A mesh point, the gradient and the velocity there.
  void observe(ConstraintGradient<S>& gradient, const Vector<S>& v, const Snapshot<S>& snapshot);

  void remember(Archive& archive) {
    for (OfConstraint& c : of_) archive(c.hidden, c.greatest, c.speed, c.lambda, c.t, c.reach, c.length);
    archive(squares_);
  }

  struct Worst {
    S cosine = 0;
    Index constraint = 0;
    S t = 0;
  };
  /// Mechanisms that are held at rest have none. What rounding leaves of the constraint forces in a step of this
  /// length, `rounding` of them, is no speed.
  Worst worst(const S& step, const S& rounding) const;

  /// The greatest ratio of a constraint's maximum in the last quarter of the run to that in the first. It is of
  /// constraints that grew from quarter to quarter, and to more than `least`. 0 if none did.
  struct Growth {
    double factor = 0;
    Index constraint = 0;
  };
  Growth growth(const S& least) const;

  /// The sum over the constraints of the greatest |lambda_a| times the greatest speed: no power of the constraint
  /// forces is more. They do no work but for rounding, which is epsilon of it.
  S power() const;

 private:
  struct Part {
    Index first, count, coordinate;  ///< stored columns of a gradient, and where its body's velocity begins
  };
  struct OfConstraint {
    std::vector<Part> parts;
    std::size_t mechanism = 0;  ///< a mass block that stands for all that are joined
    std::array<S, 4> hidden{};  ///< greatest in each quarter
    S greatest = 0, speed = 0, lambda = 0, t = 0;
    /// Where it was greatest: the sum over the bodies of sqrt(grad_b g_a^T M_b^-1 grad_b g_a m_b), and
    /// sqrt(grad g_a^T M^-1 grad g_a).
    S reach = 0, length = 0;
  };
  void join();
  void measure(ConstraintGradient<S>& gradient, Index a, OfConstraint& c);
  S cosine(const OfConstraint& c, const S& hidden) const;

  const Problem<S>& problem_;
  Index dimension_;
  long steps_;
  std::vector<OfConstraint> of_;
  std::vector<std::size_t> body_of_;    ///< the mass block of each coordinate
  std::vector<std::size_t> mechanism_;  ///< of each mass block
  std::vector<S> squares_;              ///< of each mass block's mechanism: V^2
  S hidden_, gradient_square_, speed_square_, speed_, t_;
};

}  // namespace hbvm::core

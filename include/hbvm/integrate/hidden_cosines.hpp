#pragma once

#include <array>

#include "hbvm/integrate/observer.hpp"
#include "hbvm/problem/constraint_gradient.hpp"

namespace hbvm {

/// The hidden constraints relative to the speed: for each constraint the greatest |grad g_a^T v| over the mesh, divided
/// by the greatest sum over the bodies (or directors) it touches of |grad_i g_a| |v_i|. At most 1: the cosine of the
/// angle at which the constraint is left. Masses do not enter, so that a light body counts as much as a heavy one; the
/// greatest speed over the path does, so that turning points do not.
template <Scalar S>
class HiddenCosines {
 public:
  /// The problem must outlive it; `steps` is the number of steps of the run.
  HiddenCosines(const Problem<S>& problem, long steps);

  /// A mesh point, the gradient and the velocity there.
  void observe(ConstraintGradient<S>& gradient, const Vector<S>& v, const Snapshot<S>& snapshot);

  void remember(Archive& archive) {
    for (OfConstraint& c : of_) archive(c.hidden, c.greatest, c.speed, c.lambda, c.t);
  }

  struct Worst {
    S cosine = 0;
    Index constraint = 0;
    S t = 0;
  };
  Worst worst() const;

  /// The greatest ratio of a constraint's maximum in the last quarter of the run to that in the first, among those that
  /// grew from quarter to quarter and to more than `least`; 0 if none did.
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
    std::array<S, 4> hidden{};  ///< greatest in each quarter
    S greatest = 0, speed = 0, lambda = 0, t = 0;
  };
  S cosine(const OfConstraint& c, const S& hidden) const;

  Index dimension_;
  long steps_;
  std::vector<OfConstraint> of_;
  S hidden_, gradient_square_, speed_square_, speed_, t_;
};

#define HBVM_DECLARE(S) extern template class HiddenCosines<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DECLARE)
#undef HBVM_DECLARE

}  // namespace hbvm

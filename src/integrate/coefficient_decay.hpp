#pragma once

#include <vector>

#include "integrate/observer.hpp"

namespace hbvm::core {

/// Whether the steps resolve the motion, body by body. The momentum of (54) over a step is the polynomial
/// sum_{j <= s} gamma_j P_j, whose last coefficient the stages neglect:
///
///     gamma_s = (p1 - sum_{j < s} P_j(1) gamma_j)/P_s(1),   P_j(1) = sqrt(2j + 1).
///
/// Its greatest size over the run is compared with that of sum_{1 <= j <= s} |gamma_j|, what the momentum varies by.
/// The mean gamma_0 is left out, so that a common motion hides nothing. A body that turns by the angle x a step has x/8
/// for s = 2, and so on by Bessel's functions. A free one has 0. With s = 1 nothing but gamma_1 would be left. Then the
/// change of the mean force from one step to the next is compared with the force.
///
/// Coefficients within round-off do not count. It is 1024 epsilon of the momentum, of h times the force, and of what
/// would move the body by its position in a step. Bodies are blocks of `dimension` coordinates, each compared with its
/// own.
template <Scalar S>
class CoefficientDecay final : public StepObserver<S> {
 public:
  /// The problem must outlive it.
  CoefficientDecay(const Problem<S>& problem, int s, const S& step);

  /// Nothing of a step without polynomials. Allocates nothing.
  void observe(const StepResult<S>& step, const State<S>& end) override;

  void remember(Archive& archive) override {
    for (Body& body : bodies_) archive(body.mean, body.force, body.varying, body.neglected);
    archive(before_, has_before_);
  }

  struct Worst {
    double ratio = 0;
    Index offset = 0;  ///< of the block of coordinates
  };
  /// The worst ratio over the run so far; q are the positions at any mesh point.
  Worst worst(const Vector<S>& q) const;
  /// A step is too large where the ratio exceeds 1/limit.
  int limit() const { return s_ > 1 ? 8 : 2; }

 private:
  struct Body {
    S mean = 0, force = 0, varying = 0, neglected = 0;  ///< greatest sizes over the run
  };

  const Problem<S>& problem_;
  Index dimension_;
  int s_;
  S h_;
  std::vector<S> P_at_1_;
  std::vector<Body> bodies_;
  Vector<S> before_;  ///< of s = 1: p1 - gamma_0 of the last step
  bool has_before_ = false;
  S size_, sum_, rest_, norm_, t_;
};

}  // namespace hbvm::core

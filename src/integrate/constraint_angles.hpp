#pragma once

#include "integrate/observer.hpp"
#include "linear/inverse_diagonal.hpp"
#include "linear/ordering.hpp"
#include "problem/constraint_gradient.hpp"

namespace hbvm::core {

/// How close the constraints come to dependence over the mesh. It is seen by angles alone, so that units, a light body
/// beside a heavy one, and the order of the constraints do not count. For each gradient there is sin^2 of its angle, in
/// the metric M^-1, with the span of the others. That is 1/(C^-1)_aa of the Gram matrix C of the normalised gradients.
/// There is also the length of each gradient. Both vanish where (3) does not hold.
///
/// Seen from the mesh, a motion that crosses a singular position does so nearly along a line. A sine or length is
/// proportional to |n - n*| there, for the real n* of the crossing. Among the mesh points next to n* and those beyond,
/// two neighbours then differ by a factor of 3 at least, whatever the step. It is 3 with n* in the middle of a step. So
/// neighbours that differ by 2 tell of a position passed that is singular, or nearer to it than the step resolves.
/// Where the step resolves the passage the factor goes to 1.
template <Scalar S>
class ConstraintAngles {
 public:
  /// The problem must outlive it.
  explicit ConstraintAngles(const Problem<S>& problem);

  /// A mesh point, and the gradient there.
  void observe(ConstraintGradient<S>& gradient, const Snapshot<S>& snapshot);

  void remember(Archive& archive) {
    auto known = static_cast<long>(closest_q_.size());
    archive(known);
    if (archive.reading()) closest_q_.resize(known);
    if (known > 0) archive(closest_q_);
    archive(closest_, closest_t_, squares_, squares_before_, lengths_, angles_, angles_before_, known_before_);
    archive(change_.factor, change_.constraint, change_.of_length, change_.t);
  }

  /// The mesh point where a gradient came closest to the span of the others; before the first observation none.
  const Vector<S>& closest_q() const { return closest_q_; }
  const S& closest_t() const { return closest_t_; }

  /// The greatest factor by which a sine or the length of a gradient differed at two neighbours, of which t is the
  /// later.
  struct Change {
    double factor = 1;
    Index constraint = 0;
    bool of_length = false;
    S t = 0;
  };
  static constexpr int unresolved = 2;  ///< the factor from which on a passage may have been missed
  const Change& greatest_change() const { return change_; }

 private:
  void set_up(ConstraintGradient<S>& gradient);
  void see_change(double square, Index constraint, bool of_length, const S& t);
  [[nodiscard]] bool find_angles();
  Index place(Index a) const { return order_.position[static_cast<std::size_t>(a)]; }

  Index nu_;
  Ordering order_;
  InverseDiagonal<double> inverse_;
  InverseDiagonal<S> precise_;  ///< where double does not decide
  std::vector<S> squares_, squares_before_, lengths_;
  std::vector<S> cosines_;  ///< of the couplings a > b, in their order
  std::vector<std::pair<Index, Index>> pairs_;
  std::vector<double> angles_, angles_before_;  ///< 1/sin^2
  bool known_before_ = false;
  double closest_ = 0;
  Vector<S> closest_q_;
  S closest_t_ = 0, product_;
  Change change_;
};

}  // namespace hbvm::core

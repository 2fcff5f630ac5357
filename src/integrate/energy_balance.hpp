#pragma once

#include <deque>

#include "integrate/energy_change.hpp"
#include "problem/problem.hpp"

namespace hbvm::core {

/// The greatest |H_n - H_0| over the mesh, of H less the work done, and what it is to be compared with. That is the
/// greatest of the terms of H along the path, |T| and each effect's |U|.
template <Scalar S>
class EnergyBalance {
 public:
  /// The problem must outlive it.
  explicit EnergyBalance(const Problem<S>& problem);

  /// A mesh point and the velocity there.
  void observe(const Vector<S>& v, const Snapshot<S>& snapshot);

  void remember(Archive& archive) { archive(H0_, H_, error_, size_, t_, q_, change_); }

  const S& error() const { return error_; }
  const S& size() const { return size_; }
  /// Where the error is greatest.
  const S& t() const { return t_; }
  /// What rounding the coordinates by epsilon changes H by there. It is the size, or sum_i |q_i dU/dq_i| if that is
  /// more, as where a stiff spring is far from the origin.
  S rounding();
  /// Terms of the sums that H is.
  long count() const { return count_; }
  /// Whether so much of it is lost that the motion is another.
  typename EnergyChange<S>::Change change() const { return change_.change(); }

 private:
  const Problem<S>& problem_;
  std::deque<Potential<S>> effects_;  ///< of one term each
  std::deque<PotentialEvaluator<S>> values_;
  Vector<S> U_, q_;
  EnergyChange<S> change_;
  long count_;
  S H0_ = 0, H_ = 0, error_ = 0, size_ = 0, t_ = 0, kinetic_;
};

}  // namespace hbvm::core

#pragma once

#include <vector>

#include "problem/problem.hpp"

namespace hbvm::core {

/// How far the constraints that are not quadratic, which a method keeps with enough nodes only, have moved from their
/// values at a state. The problem must outlive it.
template <Scalar S>
class GeneralDrift {
 public:
  explicit GeneralDrift(const Problem<S>& problem);

  /// True if all constraints are quadratic.
  bool empty() const { return constraints_.empty(); }
  void start(const Vector<S>& q);
  /// The greatest |g(q) - g(start)| over twice epsilon times the greatest size of g, which its round-off is
  /// proportional to. It is taken of all q that were looked at since the start: 1 is what rounding once at either end
  /// makes of it.
  const S& in_units(const Vector<S>& q);

  template <class Archive>
  void remember(Archive& archive) {
    archive(start_, size_);
  }

 private:
  const Problem<S>& problem_;
  std::vector<const Constraint<S>*> constraints_;
  Vector<S> start_, size_;
  S epsilon_, units_ = 0;
};

}  // namespace hbvm::core

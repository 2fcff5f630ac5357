#pragma once

#include <optional>
#include <string>
#include <vector>

#include "problem/constraint_gradient.hpp"
#include "problem/driven_course.hpp"

namespace hbvm::core {

/// The constraints of a problem that its solvers do not see, because they follow from the others. It knows whether they
/// are kept to, and the multipliers of all constraints. Owns its storage; one a thread.
template <Scalar S>
class RedundantConstraints {
 public:
  explicit RedundantConstraints(const Problem<S>& problem);

  bool empty() const { return places_.empty(); }
  /// Their numbers among all constraints, ascending from 0, and their names.
  const std::vector<Index>& places() const { return places_; }
  const std::string& name(std::size_t r) const { return all_.constraints[static_cast<std::size_t>(places_[r])].name; }

  /// g(q) of the redundant ones; sizes() are then the sums of the magnitudes of their terms.
  const Vector<S>& values(const Vector<S>& q);
  const Vector<S>& sizes() const { return sizes_; }
  /// grad g^T M^-1 p of the redundant ones.
  const Vector<S>& hidden(const Vector<S>& q, const Vector<S>& p);

  /// The multipliers of all constraints that exert the same force at q as those of the independent ones do. They are
  /// the ones of least Euclidean norm. With grad g_r = grad g X they are lambda - X mu and mu, (1 + X^T X) mu = X^T
  /// lambda.
  /// \throws IntegrationError if the gradients of the independent constraints are dependent at q
  Vector<S> multipliers(const Vector<S>& q, const Vector<S>& lambda);

 private:
  Problem<S> all_;                    // with every constraint in its place, if some are redundant
  std::vector<Index> kept_, places_;  // of the independent and the redundant ones
  std::optional<ConstraintGradient<S>> gradient_;
  Vector<S> values_, sizes_, hidden_, v_;
  std::optional<DrivenCourse<S>> course_;
};

/// All constraints, redundant ones included, in order.
template <Scalar S>
std::vector<Constraint<S>> all_constraints(const Problem<S>& problem);

/// Their names.
template <Scalar S>
std::vector<std::string> names_of_constraints(const Problem<S>& problem);

}  // namespace hbvm::core

#pragma once

#include "problem/problem.hpp"
#include "solver/stopping_rule.hpp"

namespace hbvm::core {

/// The scale of each body: the greatest that StoppingRule has found for one of its coordinates. Changes of momenta are
/// measured by it.
template <Scalar S>
class BodyScale {
 public:
  explicit BodyScale(const Problem<S>& problem);

  /// Keeps the scales of now.
  void keep(const StoppingRule<S>& rule);
  /// For each coordinate the kept scale of its body.
  const Vector<S>& of_coordinates() const { return scale_; }
  /// size = the greatest entry of `change`, a column for each coordinate, each entry over the kept scale of its body.
  /// A body whose scale was 0 is measured by the scales of now, each coordinate by its own.
  void measure(const Matrix<S>& change, const StoppingRule<S>& rule, S& size);
  /// Whether for each body the entries are at most a sixteenth of its scale of now.
  bool leaves_little(const Matrix<S>& residual, const StoppingRule<S>& rule);

 private:
  const Problem<S>& problem_;
  Vector<S> scale_;
  S scale_now_ = 0, greatest_ = 0;
};

}  // namespace hbvm::core

#pragma once

#include <complex>
#include <vector>

#include "problem/problem.hpp"
#include "problem/state_evaluator.hpp"

namespace hbvm::core {

/// A consistent state: q fulfils g, and p the hidden constraints.
struct PhaseState {
  Vector<Mpfr> q, p;
};

/// Changes of a consistent state, q over p, each over the size that positions or momenta have at the start of a motion.
/// Where that is at rest, p is that of a motion over q in a unit of time.
class TangentSpace {
 public:
  /// Scales are those of this state. The problem must outlive it.
  TangentSpace(const Problem<Mpfr>& problem, const PhaseState& start);

  /// (a - b) / by
  Vector<Mpfr> change(const PhaseState& a, const PhaseState& b, const Mpfr& by) const;
  /// The state that is consistent and nearest to one that is changed.
  PhaseState moved(const PhaseState& from, const Vector<Mpfr>& change);
  /// Directions in which it can be moved, orthonormal: of the unit vectors' projections those that stand best apart.
  /// \param small by which it is moved to find them
  Matrix<Mpfr> basis(const PhaseState& at, const Mpfr& small);
  /// Columns of changes without the scales.
  Matrix<Mpfr> unscaled(const Matrix<Mpfr>& changes) const;

  const Mpfr& q_scale() const { return q_scale_; }
  const Mpfr& p_scale() const { return p_scale_; }
  Index dimension() const { return 2 * (problem_.m() - problem_.nu()); }

 private:
  const Problem<Mpfr>& problem_;
  StateEvaluator<Mpfr> point_;
  Mpfr q_scale_, p_scale_;
};

/// The eigenvalues of start^+ end, from the greatest on. Of a motion that closes, whose changes at the start have
/// become those at the end, they are the multipliers.
std::vector<std::complex<double>> multipliers_of(const Matrix<Mpfr>& start, const Matrix<Mpfr>& end);

}  // namespace hbvm::core

#pragma once

#include "linear/lu.hpp"
#include "linear/ordering.hpp"
#include "problem/curvature.hpp"
#include "problem/force_slopes.hpp"
#include "solver/part_count.hpp"
#include "solver/stage_equations.hpp"

namespace hbvm::core {

/// The derivative of the StageResidual by gamma and h lambda, factored: s (m + nu) unknowns whatever k is.
///
/// With W = M^-1 and, at the nodes,
///
///     H_n = grad^2 U + dF/dq and B_n = dF/dv at c_hat_n,   L_n = sum_a lambda_a grad^2 g_a and D_n = (grad^2 g_a W
///     v_n)_a at c_n,
///
/// it is
///
///     d momentum_i   / d gamma_j       = delta_ij - h^2 sum_n (X P_hat^T Omega_hat)_in H_n I_hat_nj W
///                                                 - h sum_n (X P_hat^T Omega_hat)_in B_n P_hat_nj W
///                                                 + h^2 sum_n (X P^T Omega)_in L_n I_nj W
///     d momentum_i   / d (h lambda_n)  = (X P^T Omega)_in grad g_n
///     d constraint_n / d gamma_j       = P_nj grad g_n^T W + h I_nj D_n^T W
///
/// where lambda has coefficients, X P^T Omega diag(grad g) P and P^T Omega times the third.
///
/// Its rows and columns are brought to the size of velocities by powers of two, which depend on the masses and on the
/// gradients alone. So neither units nor a light body beside a heavy one change a pivot or a digit.
///
/// Unknowns are ordered by the graph of the bodies: for a chain of bodies the matrix is banded, and costs in proportion
/// to their number.
template <Scalar S>
class Jacobian {
 public:
  /// The problem and the method must outlive it.
  Jacobian(const Problem<S>& problem, const Hbvm<S>& method);

  /// Evaluates and factors at the last nodes of `at`, where the multipliers were `lambda`,
  /// for a step of its size.
  /// \return false if it is singular or not finite
  [[nodiscard]] bool factor(const StageEquations<S>& at, const Matrix<S>& lambda);

  /// Takes the residual to J^-1 residual: its momentum becomes a change of gamma, its constraint one of h lambda.
  void solve(StageResidual<S>& r);

  /// Powers of two by which residuals are divided before they are solved for. A coordinate has one for its momentum, a
  /// multiplier one for its constraint.
  long coordinate_exponent(Index j) const { return coordinate_exponents_[static_cast<std::size_t>(j)]; }
  long constraint_exponent(Index a) const { return row_exponents_[static_cast<std::size_t>(a)]; }
  /// solve() for a residual divided by them already.
  void solve_scaled(StageResidual<S>& r);

  Index unknowns() const { return n_; }
  Index half_bandwidth() const { return matrix_.half_bandwidth(); }
  /// How often it was assembled, factored and solved with, and what each takes.
  const std::vector<PartCount>& part_counts() const { return parts_; }
  /// Operations of a new one, assembled and factored, and of a solution with it.
  std::uint64_t evaluation_cost() const { return (parts_[assembly].per_call + parts_[factors].per_call).total(); }
  std::uint64_t solution_cost() const { return parts_[corrections].per_call.total(); }

  /// The factors, and how the matrix was scaled.
  void remember(Archive& archive) {
    archive(matrix_, row_exponents_, column_exponents_, row_factors_, column_factors_);
  }

 private:
  enum Part { assembly, factors, corrections };
  /// Of second derivatives of U at the nodes only what joins them to the matrix.
  OperationCounts assembly_operations() const;
  /// block_ += factor sum_n X_in w_n I_nj.
  void add_weighted(const S& factor, const Matrix<S>& X, const S* w, const Matrix<S>& I);
  void assemble(const StageEquations<S>& at, const Matrix<S>& lambda);
  /// Adds block_ times what M^-1 makes of a column of coordinates, in the rows of a coordinate.
  void spread_block(Index row, Index column);
  /// block_ = projection diag(w) F, for w at the constraints' nodes.
  void set_rows(const S* w, const Matrix<S>& F);
  /// Adds block_ times what M^-1 makes of a column of coordinates, in the rows of a constraint.
  void add_rows(Index constraint, Index coordinate, const S& factor);
  /// Exponents of the constraints' rows and columns from the gradients at hand.
  void choose_scales(const ConstraintGradient<S>& gradient);
  void scale();
  Index of_coordinate(Index j) const { return order_.position[static_cast<std::size_t>(j)] * method_.s; }
  Index of_multiplier(Index a) const { return order_.position[static_cast<std::size_t>(bodies_ + a)] * method_.s; }

  const Problem<S>& problem_;
  const Hbvm<S>& method_;
  Curvature<S> curvature_;
  ForceSlopes<S> slopes_;
  Index bodies_;                                     ///< coordinates that have a gamma; driven ones come after these
  std::vector<std::vector<std::pair<Index, S>>> W_;  ///< nonzeros of M^-1, row by row
  Matrix<S> X_hat_, X_projection_;                   ///< X P_hat^T Omega_hat and X P^T Omega
  Ordering order_;
  Index n_ = 0;
  Lu<S> matrix_;
  std::vector<long> coordinate_exponents_, row_exponents_, column_exponents_;  ///< of j; of a
  std::vector<S> row_factors_, column_factors_;  ///< of the unknowns in their order: 2^-exponent and 2^exponent
  Vector<S> x_;
  Matrix<S> block_, curved_, weighted_;
  Vector<S> at_nodes_;  ///< r
  std::vector<PartCount> parts_;
};

}  // namespace hbvm::core

#pragma once

#include <vector>

#include "linear/arrays.hpp"
#include "linear/in_double.hpp"
#include "linear/lu.hpp"
#include "linear/ordering.hpp"
#include "linear/parity_matrix.hpp"
#include "method/hbvm.hpp"
#include "problem/constraint_gradient.hpp"
#include "problem/force_evaluator.hpp"
#include "solver/part_count.hpp"

namespace hbvm::core {

/// The unknowns of one step, by Fourier coefficient or node.
template <Scalar S>
struct StageUnknowns {
  Matrix<S> gamma;   ///< s x m: coefficients of v, (49)
  Matrix<S> psi;     ///< s x m: psi_hat, coefficients of grad U, (50)
  Matrix<S> zeta;    ///< s x m: coefficients of grad g lambda, (49)
  Matrix<S> lambda;  ///< s x nu: multipliers at the nodes c_i, or their coefficients if there are more nodes than s
};

template <Scalar S>
void set(StageUnknowns<S>& to, const StageUnknowns<S>& from) {
  set(to.gamma, from.gamma);
  set(to.psi, from.psi);
  set(to.zeta, from.zeta);
  set(to.lambda, from.lambda);
}

/// What is left of the stage equations at some unknowns, 0 at a solution:
///
///     momentum   = gamma - e_1 p0 - h X_s (psi_hat - zeta)          s x m, (54)
///     constraint = grad g(u_i)^T M^-1 v_i, v_i = sum_j P_j(c_i) gamma_j   s x nu, (52)
///
/// Of driven coordinates the momentum's is 0: their gamma is, since nothing depends on it. The velocities in the
/// constraint's are theirs.
///
/// or, with r > s nodes for constraints that are not quadratic, the first s Legendre coefficients of the latter.
template <Scalar S>
struct StageResidual {
  Matrix<S> momentum, constraint;
};

/// What a step adds, by (56): q1 - q0 = h M^-1 gamma_0 and p1 - p0 = h (psi_0 - zeta_0), which is p + p_rest. The
/// rest is what rounding of the sum takes from a constant force. It has the same bits wherever the constraints' force
/// beside it is of one binade. Left out, it would be a small force of its own, under which H drifts. Newton's last
/// correction, too small for p, is in it as well.
template <Scalar S>
struct StepChange {
  Vector<S> q, p, p_rest;
  explicit StepChange(Index m) : q(m), p(m), p_rest(Vector<S>::Zero(m)) {}
};

/// Where a step starts, and its size h: q0 and p0, and what rounding took from them in the steps before, if it is
/// known. Then the step is one from q0 + q_carry, p0 + p_carry. What rounding of its positions does to H and g has no
/// pattern then, and adds up like a random walk.
template <Scalar S>
struct StepStart {
  const Vector<S>&q, &p;
  const S& h;
  const Vector<S>*q_carry = nullptr, *p_carry = nullptr;
};

/// The maps of which the stage equations (54) consist. Owns all storage they need. Problem and method must
/// outlive it.
template <Scalar S>
class StageEquations {
 public:
  StageEquations(const Problem<S>& problem, const Hbvm<S>& method);

  const Problem<S>& problem() const { return problem_; }
  const Hbvm<S>& method() const { return method_; }
  /// The size of the step that was started last.
  const S& step() const { return h_; }
  StageUnknowns<S> make_unknowns() const;

  /// The vectors must live as long as the step.
  void start(const StepStart<S>& start);
  const Vector<S>& q0() const { return *q0_; }
  const Vector<S>& p0() const { return *p0_; }

  /// Moves all nodes to the polynomial u of (48) with these coefficients: keeps h M^-1 gamma.
  void move(const Matrix<S>& gamma);
  /// psi = P_hat^T Omega_hat (grad U + F)(u at c_hat), after move(). F is evaluated at M^-1 sum_j P_j(c_hat_i) gamma_j,
  /// which is u' there. So a force that does no work does none in a step, node by node.
  void forces(Matrix<S>& psi);
  /// Changes lambda so that the momenta that follow from it and psi fulfil the hidden constraints at the current nodes.
  /// Then sets zeta = P_s^T Omega (grad g lambda). Without constraints it does nothing. The multipliers solve (29),
  ///
  ///     sum_j a_ij grad g_i^T M^-1 grad g_j (h lambda_j) = grad g_i^T M^-1 v_i,   v of psi alone,
  ///
  /// but it is solved for their change, with what lambda leaves of the hidden constraints on the right. So neither the
  /// rounding of the matrix nor its condition biases the solution. With `factor` false the last matrix serves again.
  /// \return false if the matrix is singular to working precision
  [[nodiscard]] bool multipliers(const Matrix<S>& psi, Matrix<S>& lambda, Matrix<S>& zeta, bool factor = true);
  /// An estimate of the condition of that matrix, its rows and columns brought to one scale, in the max-norm.
  double condition();
  /// gamma = e_1 p0 + h X_s (psi - zeta), which is (54) by (31).
  void momenta(const Matrix<S>& psi, const Matrix<S>& zeta, Matrix<S>& gamma);

  /// The change of the state at x, whose psi came from the last call of forces(). Of driven coordinates it is evaluated
  /// at x itself: nothing iterates to what is on them.
  void changes(const StageUnknowns<S>& x, StepChange<S>& change);

  /// The residual at x.gamma and x.lambda; sets x.psi and x.zeta, too. Moves the nodes.
  void residual(StageUnknowns<S>& x, StageResidual<S>& r);

  /// The last nodes: positions u(c_i h) and u(c_hat_i h), and velocities M^-1 v_i after residual().
  const Matrix<S>& node_positions() const { return u_; }
  const Matrix<S>& quadrature_positions() const { return method_.k == method_.r ? u_ : u_hat_; }
  const Matrix<S>& node_velocities() const { return w_; }
  const Matrix<S>& quadrature_velocities() const { return w_hat_; }
  /// The multipliers at the nodes c_i, r x nu, as residual() or multipliers() had them last.
  const Matrix<S>& node_multipliers(const Matrix<S>& lambda) const {
    return method_.has_coefficients_of_lambda() ? lambda_ : lambda;
  }
  /// Those where lambda has coefficients.
  const Matrix<S>& multipliers_at_nodes() const { return lambda_; }
  const ConstraintGradient<S>& constraint_gradient() const { return gradient_; }
  /// Rounds what residual() has found of the same equations in more digits: nodes, their velocities, the constraints'
  /// gradients, and the multipliers at the nodes.
  template <Scalar T>
  void round(const StageEquations<T>& from) requires std::same_as<S, double> {
    set_in_double(u_, from.node_positions());
    if (method_.k != method_.r) set_in_double(u_hat_, from.quadrature_positions());
    set_in_double(w_, from.node_velocities());
    if (!problem_.forces.empty()) set_in_double(w_hat_, from.quadrature_velocities());
    gradient_.round(from.constraint_gradient());
    if (method_.has_coefficients_of_lambda()) set_in_double(lambda_, from.multipliers_at_nodes());
  }

  /// What was done since construction: by effect, and by part (the forces' own work is in the effects').
  std::vector<EffectCount> effect_counts() const {
    std::vector<EffectCount> all = potential_.counts();
    all.insert(all.end(), without_potential_.counts().begin(), without_potential_.counts().end());
    return all;
  }
  const std::vector<PartCount>& part_counts() const { return parts_; }
  /// What residual() takes, with all forces evaluated.
  OperationCounts residual_operations() const;

 private:
  using Parity = ParityMatrix<S>;
  enum Part {
    velocities,
    constraint_nodes,
    quadrature_nodes,
    projection,
    gradients,
    matrix,
    factors,
    right_hand_side,
    solution,
    zetas,
    gammas,
    constraint_residual
  };
  void describe_parts();
  /// The change of the momenta of driven coordinates, from the forces at x.
  void change_accounts(const StageUnknowns<S>& x, StepChange<S>& change);
  /// Where driven points are at the nodes of the step.
  void place_driven();

  /// Of one node values and coefficients are the same numbers: P and the weight are 1.
  static bool is_one_node(Index stages, Index nodes) { return stages == 1 && nodes == 1; }
  /// f(s, r), as constants of their types where they are few. What a sweep in double does is then compiled as one
  /// function for each s.
  template <class F>
  decltype(auto) with_stages(F f);
  template <class Stages, class Nodes>
  void forces(Stages s, Nodes k, Matrix<S>& psi);
  /// Positions at c (unless they are those at c_hat) and the constraints' gradients there.
  template <class Stages, class Nodes>
  void move_constraints(Stages s, Nodes r);
  template <class Stages>
  void set_momenta(Stages s, const Matrix<S>& psi, const Matrix<S>& zeta, Matrix<S>& gamma);
  /// rest_ = (psi_0 - zeta_0)_j, for a j of pulled_, less its rounded value.
  void take_rest(const Matrix<S>& psi, const Matrix<S>& zeta, Index j);
  template <class Stages, class Nodes>
  void project_multipliers(Stages s, Nodes r, const Matrix<S>& lambda, Matrix<S>& zeta);
  /// The matrix of (29) at the current nodes, factored.
  template <class Stages, class Nodes>
  [[nodiscard]] bool factor_matrix(Stages s, Nodes r);
  /// What the velocities M^-1 v_i at the current nodes leave of the hidden constraints: grad g_i^T M^-1 v_i, or the
  /// coefficients of that. Column b is written from out(b) on.
  template <class Nodes, class Out>
  void hidden_constraints(Nodes r, const Matrix<S>& v, Out out);

  const Problem<S>& problem_;
  const Hbvm<S>& method_;
  S h_ = 0;
  PotentialEvaluator<S> potential_;
  ForceEvaluator<S> without_potential_;
  DrivenCourse<S> course_, course_hat_;  ///< at the nodes c and c_hat of the step
  bool varies_;                          ///< what psi is of
  ConstraintGradient<S> gradient_;
  Ordering order_;  // of the constraints in the matrix of (29)
  Lu<S> system_;
  const Vector<S>* q0_ = nullptr;
  const Vector<S>* p0_ = nullptr;
  const Vector<S>* q_carry_ = nullptr;
  const Vector<S>* p_carry_ = nullptr;
  Vector<S> no_carry_;                // m
  Parity I_centred_, I_hat_centred_;  ///< I_s and I_hat with c - 1/2 for c in column 0
  Parity P_, projection_, projection_hat_;
  Vector<S> middle_;                 // m: q0 + h/2 M^-1 gamma_0
  std::vector<Index> pulled_;        // the coordinates on which a constant force acts
  Vector<S> psi_rest_;               // m: what rounding took from their psi_0 in the last forces()
  Matrix<S> velocity_, h_velocity_;  // s x m
  Matrix<S> u_hat_, w_hat_, force_;  // k x m
  Matrix<S> u_, w_;                  // r x m
  Matrix<S> stage_, pull_;           // s x m
  Matrix<S> last_psi_, last_zeta_;   // s x m, where points are driven
  Matrix<S> coupling_;               // r x r
  Matrix<S> lambda_;                 // r x nu, if lambda has coefficients; as are the next four
  Vector<S> hidden_;                 // r: one of the hidden constraints at the nodes
  Matrix<S> weighted_, right_;       // r x r and r x s: of the matrix of (29)
  Matrix<S> block_;                  // s x s: likewise
  Vector<S> rhs_;                    // s nu
  S half_, h_half_ = 0, inverse_h_ = 0, rest_, t_, x_, y_;  // the last three are scratch
  std::vector<PartCount> parts_;
};

}  // namespace hbvm::core

#include "solver/stage_equations.hpp"

#include "linear/arrays.hpp"
#include "linear/constant_count.hpp"
#include "linear/product.hpp"
#include "scalar/in_place.hpp"

namespace hbvm::core {
namespace {

/// I with c_i - 1/2 for its column 0, c_i. Mirrored nodes lie as far from 1/2 as each other but for rounding; here they
/// do exactly, and rounded coefficients still make a symmetric method. Those of an asymmetric one would give errors in
/// H and g the same sign step after step.
template <Scalar S>
Matrix<S> centred(const Matrix<S>& I) {
  const S half = S(1) / 2;
  Matrix<S> result = I;
  for (Index i = 0; i < I.rows(); ++i) result(i, 0) = I(i, 0) - half;
  for (Index i = 0; 2 * i < I.rows(); ++i) {
    S& mirrored = result(I.rows() - 1 - i, 0);
    if (magnitude(S(result(i, 0) + mirrored)) <= epsilon<S>()) mirrored = -result(i, 0);
  }
  return result;
}

}  // namespace

template <Scalar S>
StageEquations<S>::StageEquations(const Problem<S>& problem, const Hbvm<S>& method)
    : problem_(problem),
      method_(method),
      potential_(problem.potential, method.k),
      without_potential_(problem, method.k),
      course_(problem, method.r),
      course_hat_(problem, method.k),
      varies_(potential_.has_varying_force() || !problem.forces.empty()),
      gradient_(problem, method.r),
      no_carry_(Vector<S>::Zero(problem.m())),
      I_centred_(centred(method.I_s), Parity::Nodes::rows, Parity::First::odd),
      I_hat_centred_(centred(method.I_hat), Parity::Nodes::rows, Parity::First::odd),
      P_(method.P_s, Parity::Nodes::rows, Parity::First::even),
      projection_(method.projection, Parity::Nodes::columns, Parity::First::even),
      projection_hat_(method.projection_hat, Parity::Nodes::columns, Parity::First::even),
      middle_(problem.m()),
      psi_rest_(Vector<S>::Zero(problem.m())),
      half_(S(1) / 2) {
  const Index s = method.s, r = method.r, m = problem.m(), nu = problem.nu();
  velocity_.resize(s, m);
  h_velocity_.resize(s, m);
  u_.resize(r, m);
  u_hat_.resize(method.k, m);
  w_hat_ = Matrix<S>::Zero(method.k, problem.is_conservative() ? 0 : m);
  force_ = Matrix<S>::Zero(method.k, m);
  w_.resize(r, m);
  stage_.resize(s, m);
  last_psi_ = last_zeta_ = Matrix<S>::Zero(course_.empty() ? 0 : s, course_.empty() ? 0 : m);
  pull_.resize(s, m);
  coupling_.resize(r, r);
  if (method.has_coefficients_of_lambda()) {
    lambda_.resize(r, nu);
    hidden_.resize(r);
    weighted_.resize(r, r);
    right_.resize(r, s);
    block_.resize(s, s);
  }
  std::vector<std::pair<Index, Index>> entries;
  for (const auto& pair : gradient_.couplings()) entries.emplace_back(pair.a, pair.b);
  order_ = order_for_band(nu, entries);
  system_.resize(s * nu, s * (order_.half_bandwidth + 1) - 1);
  rhs_.resize(s * nu);
  for (Index j = 0; j < m; ++j)
    if (potential_.constant_force()[j] != 0) pulled_.push_back(j);
  describe_parts();
}

template <Scalar S>
void StageEquations<S>::describe_parts() {
  const Index s = method_.s, k = method_.k, r = method_.r, m = problem_.m(), nu = problem_.nu();
  const bool coefficients = method_.has_coefficients_of_lambda();
  parts_ = {{"velocity coefficients h M^-1 gamma (48)"},
            {"positions at constraint nodes (48)"},
            {"positions at quadrature nodes (48)"},
            {"force coefficients psi_hat (50)"},
            {"constraint gradients"},
            {"matrix for the multipliers (29)"},
            {"LU for the multipliers (29)"},
            {"right-hand side for the multipliers (29)"},
            {"multipliers at the nodes (29)"},
            {"constraint-force coefficients zeta (49)"},
            {"momentum coefficients gamma (54)"},
            {"hidden constraints at the nodes (52)"}};
  const auto stages = static_cast<std::uint64_t>(s);
  parts_[velocities].per_call = stages * problem_.mass.operations();
  parts_[velocities].per_call.add(Op::multiply, s * m + m);
  parts_[velocities].per_call.add(Op::add, 2 * m);
  parts_[constraint_nodes].per_call = I_centred_.operations(m);
  parts_[constraint_nodes].per_call.add(Op::add, r * m);
  parts_[quadrature_nodes].per_call = I_hat_centred_.operations(m);
  parts_[quadrature_nodes].per_call.add(Op::add, k * m);
  if (varies_) parts_[projection].per_call = projection_hat_.operations(m);
  const auto pulled = static_cast<Index>(pulled_.size());
  OperationCounts exact_sum;
  exact_sum.add(Op::add, 2 * pulled);
  exact_sum.add(Op::subtract, 4 * pulled);
  parts_[projection].per_call += exact_sum;
  parts_[gradients].per_call = gradient_.operations();
  const auto blocks = static_cast<Index>(gradient_.couplings().size());
  parts_[matrix].per_call = gradient_.weighing_operations() + gradient_.own_coupling_operations();
  parts_[matrix].per_call.add(Op::multiply, blocks * r * r);
  if (coefficients) parts_[matrix].per_call.add_dots(blocks * (r + s) * s, r);
  parts_[factors].per_call = system_.factor_operations();
  parts_[solution].per_call = system_.solve_operations();
  parts_[solution].per_call.add_products(s * nu);
  parts_[zetas].per_call += gradient_.times_operations();
  if (coefficients) parts_[zetas].per_call += P_.operations(nu);
  if (!is_one_node(s, r)) parts_[zetas].per_call += projection_.operations(m);
  OperationCounts& gamma = parts_[gammas].per_call;
  gamma.add(Op::subtract, s * m);
  gamma.add(Op::multiply, 2 * s * m);
  gamma.add_products((s - 1) * m);
  gamma.add(Op::add, 2 * (m - pulled));
  gamma += exact_sum + exact_sum;
  gamma.add(Op::negate, pulled);
  gamma.add(Op::multiply, pulled);
  gamma.add(Op::add, 4 * pulled);
  OperationCounts hidden;
  for (Index a = 0; a < nu; ++a) hidden += gradient_.transposed_operations(a);
  if (coefficients) hidden.add_dots(s * nu, r);
  parts_[constraint_residual].per_call = P_.operations(m) + hidden;
  parts_[constraint_residual].per_call.add(Op::subtract, s * m);
  parts_[right_hand_side].per_call = gamma + stages * problem_.mass.operations() + hidden;
  if (!is_one_node(s, r)) parts_[right_hand_side].per_call += P_.operations(m);
}

template <Scalar S>
OperationCounts StageEquations<S>::residual_operations() const {
  OperationCounts sum;
  for (const Part part : {velocities, projection, gammas, constraint_residual}) sum += parts_[part].per_call;
  if (varies_) {
    sum += parts_[quadrature_nodes].per_call;
    for (std::size_t t = 0; t < potential_.counts().size(); ++t)
      if (!problem_.potential.terms[t].constant_force)
        sum += static_cast<std::uint64_t>(method_.k) * potential_.counts()[t].done();
    for (const EffectCount& count : without_potential_.counts())
      sum += static_cast<std::uint64_t>(method_.k) * count.done();
  }
  if (problem_.nu() == 0) return sum;
  if (method_.k != method_.r || !varies_) sum += parts_[constraint_nodes].per_call;
  return sum + parts_[gradients].per_call + parts_[zetas].per_call;
}

template <Scalar S>
StageUnknowns<S> StageEquations<S>::make_unknowns() const {
  const Index s = method_.s, m = problem_.m();
  const Matrix<S> zero = Matrix<S>::Zero(s, m);
  return {zero, zero, zero, Matrix<S>::Zero(s, problem_.nu())};
}

template <Scalar S>
void StageEquations<S>::start(const StepStart<S>& start) {
  q0_ = &start.q;
  p0_ = &start.p;
  if (start.h != h_) {
    set(h_, start.h);
    set_product(h_half_, h_, half_);
    set_quotient(inverse_h_, S(1), h_);
  }
  q_carry_ = start.q_carry ? start.q_carry : &no_carry_;
  p_carry_ = start.p_carry ? start.p_carry : &no_carry_;
  if (!course_.empty()) place_driven();
}

template <Scalar S>
void StageEquations<S>::place_driven() {
  const Index clock = problem_.clock();
  const auto set_times = [&](const Vector<S>& c, DrivenCourse<S>& course) {
    for (Index i = 0; i < c.size(); ++i) {
      set_product(t_, h_, c[i]);
      set_sum(t_, t_, (*q_carry_)[clock]);
      set_sum(course.time(i), (*q0_)[clock], t_);
    }
    course.evaluate();
  };
  set_times(method_.c, course_);
  set_times(method_.c_hat, course_hat_);
}

template <Scalar S>
void StageEquations<S>::move(const Matrix<S>& gamma) {
  const PartCall counted(parts_[velocities]);
  with_constant_count<S>(method_.s, [&]<class Stages>(Stages s) {
    problem_.mass.velocity(Lanes<const S, Stages>{gamma.data(), s}, Lanes<S, Stages>{velocity_.data(), s});
    S* __restrict const middle = middle_.data();
    S* __restrict const step = h_velocity_.data();
    const S* const velocity = velocity_.data();
    const S* const carry = q_carry_->data();
    const S* const q0 = q0_->data();
    const Held<S> h = h_, half = half_;
    const Index m = middle_.size();
#pragma GCC ivdep
    for (Index j = 0; j < m; ++j) {
      for (Index i = 0; i < s; ++i) set_product(step[j * s + i], h, velocity[j * s + i]);
      set_product(middle[j], half, step[j * s]);
      set_sum(middle[j], middle[j], carry[j]);
      set_sum(middle[j], middle[j], q0[j]);
    }
  });
}

template <Scalar S>
template <class F>
decltype(auto) StageEquations<S>::with_stages(F f) {
  const Index s = method_.s, r = method_.r;
  if (std::same_as<S, double> && r == s) return with_constant_count<S>(s, [&](auto count) { return f(count, count); });
  return f(s, r);
}

template <Scalar S>
void StageEquations<S>::forces(Matrix<S>& psi) {
  with_constant_count<S>(method_.s,
                         [&](auto s) { with_constant_count<S>(method_.k, [&](auto k) { forces(s, k, psi); }); });
}

template <Scalar S>
template <class Stages, class Nodes>
[[gnu::always_inline]] inline void StageEquations<S>::forces(Stages s, Nodes k, Matrix<S>& psi) {
  if (varies_) {
    Matrix<S>& u = method_.k == method_.r ? u_ : u_hat_;
    {
      const PartCall counted(parts_[quadrature_nodes]);
      I_hat_centred_.times_plus(k, s, u, h_velocity_, middle_);
    }
    course_hat_.set_positions(lanes(u));
    potential_.varying_force(lanes(u), force_);
    if (!problem_.is_conservative()) {
      product<S>(w_hat_, method_.P_hat, velocity_);
      course_hat_.set_velocities(lanes(w_hat_));
      without_potential_.add(lanes(std::as_const(u)), lanes(std::as_const(w_hat_)), course_hat_, force_);
    }
  }
  const PartCall counted(parts_[projection]);
  if (varies_)
    projection_hat_.times(s, k, psi, force_);
  else
    set_zero(psi);
  // A constant force has the one coefficient psi_0 = force.
  const Vector<S>& constant = potential_.constant_force();
  for (const Index j : pulled_) {
    set(x_, psi(0, j));
    set_exact_sum(psi(0, j), psi_rest_[j], x_, constant[j], t_);
  }
}

template <Scalar S>
template <class Stages, class Nodes>
[[gnu::always_inline]] inline void StageEquations<S>::move_constraints(Stages s, Nodes r) {
  // For k = r the nodes of the forces, just computed, are the constraints'.
  if (method_.k != method_.r || !varies_) {
    const PartCall counted(parts_[constraint_nodes]);
    I_centred_.times_plus(r, s, u_, h_velocity_, middle_);
    course_.set_positions(lanes(u_));
  }
  const PartCall counted(parts_[gradients]);
  gradient_.update(Lanes<const S, Nodes>{u_.data(), r}, static_cast<S*>(nullptr));
}

template <Scalar S>
bool StageEquations<S>::multipliers(const Matrix<S>& psi, Matrix<S>& lambda, Matrix<S>& zeta, bool factor) {
  if (problem_.nu() == 0) return true;
  return with_stages([&]<class Stages, class Nodes>(Stages s, Nodes r) {
    move_constraints(s, r);
    if (factor && !factor_matrix(s, r)) return false;
    S* const rhs = rhs_.data();
    const Index* const position = order_.position.data();
    project_multipliers(s, r, lambda, zeta);
    {
      const PartCall counted(parts_[right_hand_side]);
      set_momenta(s, psi, zeta, stage_);
      problem_.mass.velocity(Lanes<const S, Stages>{stage_.data(), s}, Lanes<S, Stages>{velocity_.data(), s});
      if (!is_one_node(s, r)) P_.times(r, s, w_, velocity_);
      course_.set_velocities(lanes(is_one_node(s, r) ? velocity_ : w_));
      hidden_constraints(r, is_one_node(s, r) ? velocity_ : w_, [&](Index a) { return rhs + position[a] * s; });
    }
    {
      const PartCall counted(parts_[solution]);
      system_.solve(rhs_);
      HeldScratch<S> t = t_;
      const Held<S> inverse_h = inverse_h_;
      S* sum = lambda.data();
      for (Index a = 0; a < problem_.nu(); ++a)
        for (Index i = 0; i < s; ++i, ++sum) add_product(*sum, inverse_h, rhs[position[a] * s + i], t);
    }
    project_multipliers(s, r, lambda, zeta);
    return true;
  });
}

template <Scalar S>
template <class Stages, class Nodes>
[[gnu::noinline]] bool StageEquations<S>::factor_matrix(Stages s, Nodes r) {
  const Index* const position = order_.position.data();
  // Of coefficients the block is projection (A at, entry by entry) P_s.
  const auto set_block = [&](const auto& at) {
    for (Index j = 0; j < weighted_.cols(); ++j)
      for (Index i = 0; i < weighted_.rows(); ++i) set_product(weighted_(i, j), at(i, j), method_.A(i, j));
    product<S>(right_, weighted_, method_.P_s);
    product<S>(block_, method_.projection, right_);
  };
  {
    const PartCall counted(parts_[matrix]);
    system_.set_zero();
    gradient_.for_each_own_coupling(r, coupling_.data(), [&](Index a, Index b, const auto& at) {
      const Index row = position[a] * s, column = position[b] * s;
      if (method_.has_coefficients_of_lambda()) {
        set_block(at);
        for (Index j = 0; j < s; ++j)
          for (Index i = 0; i < s; ++i) set(system_.entry(row + i, column + j), block_(i, j));
        return;
      }
      for (Index j = 0; j < s; ++j)
        for (Index i = 0; i < s; ++i) set_product(system_.entry(row + i, column + j), at(i, j), method_.A(i, j));
    });
  }
  const PartCall counted(parts_[factors]);
  return system_.factor();
}

template <Scalar S>
template <class Stages, class Nodes>
[[gnu::always_inline]] inline void StageEquations<S>::project_multipliers(Stages s, Nodes r, const Matrix<S>& lambda,
                                                                          Matrix<S>& zeta) {
  const PartCall counted(parts_[zetas]);
  Matrix<S>& pull = is_one_node(s, r) ? zeta : w_;
  set_zero(pull);
  if (method_.has_coefficients_of_lambda()) P_.times(lambda_, lambda);
  gradient_.add_times(node_multipliers(lambda), Lanes<S, Nodes>{pull.data(), r});
  course_.make_powers(lanes(pull));
  if (!is_one_node(s, r)) projection_.times(s, r, zeta, w_);
}

template <Scalar S>
template <class Nodes, class Out>
[[gnu::always_inline]] inline void StageEquations<S>::hidden_constraints(Nodes r, const Matrix<S>& v, Out out) {
  if (!method_.has_coefficients_of_lambda()) {
    gradient_.transposed_times(Lanes<const S, Nodes>{v.data(), r}, out);
    return;
  }
  for (Index b = 0; b < problem_.nu(); ++b) {
    gradient_.transposed_times(b, lanes(v), hidden_.data());
    set_times(out(b), method_.projection, hidden_.data(), 1);
  }
}

template <Scalar S>
void StageEquations<S>::changes(const StageUnknowns<S>& x, StepChange<S>& change) {
  auto& [q, p, p_rest] = change;
  for (Index j = 0; j < p.size(); ++j) set(p[j], x.gamma(0, j));
  problem_.mass.velocity(lanes(std::as_const(p)), lanes(q));
  for (Index j = 0; j < p.size(); ++j) {
    set_product(q[j], q[j], h_);
    set_difference(p[j], x.psi(0, j), x.zeta(0, j));
    set_product(p[j], p[j], h_);
    set_zero(p_rest[j]);
  }
  for (const Index j : pulled_) {
    take_rest(x.psi, x.zeta, j);
    set_product(p_rest[j], rest_, h_);
  }
  if (!course_.empty()) change_accounts(x, change);
}

template <Scalar S>
void StageEquations<S>::change_accounts(const StageUnknowns<S>& x, StepChange<S>& change) {
  move(x.gamma);
  forces(last_psi_);
  set_zero(last_zeta_);
  if (problem_.nu() > 0)
    with_stages([&](auto s, auto r) {
      move_constraints(s, r);
      project_multipliers(s, r, x.lambda, last_zeta_);
    });
  for (Index j = problem_.clock(); j < problem_.m(); ++j) {
    set_difference(change.p[j], last_psi_(0, j), last_zeta_(0, j));
    set_product(change.p[j], change.p[j], h_);
  }
}

template <Scalar S>
void StageEquations<S>::residual(StageUnknowns<S>& x, StageResidual<S>& residual) {
  move(x.gamma);
  forces(x.psi);
  const bool constrained = problem_.nu() > 0;
  with_stages([&](auto s, auto r) {
    if (constrained) {
      move_constraints(s, r);
      project_multipliers(s, r, x.lambda, x.zeta);
    }
    {
      const PartCall counted(parts_[gammas]);
      set_momenta(s, x.psi, x.zeta, residual.momentum);
    }
    const PartCall counted(parts_[constraint_residual]);
    set_difference(residual.momentum, x.gamma, residual.momentum);
    if (!constrained) return;
    P_.times(r, s, w_, velocity_);
    course_.set_velocities(lanes(w_));
    S* const hidden = residual.constraint.data();
    hidden_constraints(r, w_, [&](Index b) { return hidden + b * s; });
  });
}

template <Scalar S>
void StageEquations<S>::momenta(const Matrix<S>& psi, const Matrix<S>& zeta, Matrix<S>& gamma) {
  const PartCall counted(parts_[gammas]);
  with_constant_count<S>(method_.s, [&](auto s) { set_momenta(s, psi, zeta, gamma); });
}

template <Scalar S>
template <class Stages>
[[gnu::always_inline]] inline void StageEquations<S>::set_momenta(Stages s, const Matrix<S>& psi, const Matrix<S>& zeta,
                                                                  Matrix<S>& gamma) {
  const S* const X = method_.X_s.data();
  S* __restrict const sums = gamma.data();
  S* __restrict const pull = pull_.data();
  const S* __restrict const forces = psi.data();
  const S* __restrict const constraints = zeta.data();
  const S* __restrict const carry = p_carry_->data();
  const S* __restrict const p0 = p0_->data();
  const Held<S> h = h_;
  const Index m = problem_.mass.of_bodies();
  for (Index i = m * s; i < gamma.size(); ++i) set_zero(sums[i]);
  const auto at = [&](Index i, Index j) { return i + j * s; };
  const auto set_sums = [&](Index j) __attribute__((always_inline)) {
    HeldScratch<S> t = t_;
    for (Index i = 0; i < s; ++i) set_difference(pull[at(i, j)], forces[at(i, j)], constraints[at(i, j)]);
    for (Index i = 0; i < s; ++i) {
      S& sum = sums[at(i, j)];
      if (i == 0)
        set_product(sum, X[0], pull[at(0, j)]);
      else
        set_product(sum, X[at(i, i - 1)], pull[at(i - 1, j)]);
      if (i + 1 < s) add_product(sum, X[at(i, i + 1)], pull[at(i + 1, j)], t);
      set_product(sum, sum, h);
    }
  };
  const auto add_start = [&](Index j) __attribute__((always_inline)) {
    set_sum(sums[at(0, j)], sums[at(0, j)], carry[j]);
    set_sum(sums[at(0, j)], sums[at(0, j)], p0[j]);
  };
  const auto set_all = [&](Index first, Index end) __attribute__((always_inline)) {
#pragma GCC ivdep
    for (Index j = first; j < end; ++j) {
      set_sums(j);
      add_start(j);
    }
  };
  if (pulled_.empty()) return set_all(0, m);
  Index first = 0;
  for (const Index j : pulled_) {
    set_all(first, j);
    set_sums(j);
    first = j + 1;
    // As in StepChange: without the rest, gamma_0 = p0 + h/2 (psi_0 - zeta_0) + ... would have a bias.
    take_rest(psi, zeta, j);
    set_product(rest_, rest_, h_half_);
    set_sum(rest_, rest_, carry[j]);
    set(x_, sums[at(0, j)]);
    set_exact_sum(sums[at(0, j)], y_, x_, p0[j], t_);
    set_sum(rest_, rest_, y_);
    set_sum(sums[at(0, j)], sums[at(0, j)], rest_);
  }
  set_all(first, m);
}

template <Scalar S>
void StageEquations<S>::take_rest(const Matrix<S>& psi, const Matrix<S>& zeta, Index j) {
  set_negative(x_, zeta(0, j));
  set_exact_sum(y_, rest_, psi(0, j), x_, t_);
  set_sum(rest_, rest_, psi_rest_[j]);
}

#define HBVM_DEFINE(S) template class StageEquations<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

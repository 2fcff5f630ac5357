#include "step/runge_kutta_stepper.hpp"

#include "copy_state.hpp"
#include "linear/arrays.hpp"
#include "linear/product.hpp"
#include "scalar/in_place.hpp"
#include "scalar/literal.hpp"
#include "step/move_driven.hpp"
#include "step/stage_iteration.hpp"

namespace hbvm::core {
namespace {

template <Scalar S>
bool is_strictly_lower(const Matrix<S>& A) {
  for (Index j = 0; j < A.cols(); ++j)
    for (Index i = 0; i <= j && i < A.rows(); ++i)
      if (A(i, j) != 0) return false;
  return true;
}

}  // namespace

template <Scalar S>
RungeKuttaStepper<S>::RungeKuttaStepper(const Problem<S>& problem, const RungeKutta<S>& method,
                                        const Formulation& formulation)
    : problem_(problem),
      A_(method.A),
      explicit_(is_strictly_lower(method.A)),
      ggl_(formulation.on_constraints == OnConstraints::ggl && problem.nu() > 0),
      potential_(problem.potential, explicit_ ? Index(1) : method.b.size()),
      P_(Matrix<S>::Zero(method.b.size(), problem.m())),
      P_before_(P_),
      Q_(P_),
      V_(P_),
      F_(P_),
      q_(problem.m()),
      p_(problem.m()),
      v_(problem.m()),
      force_(Matrix<S>::Zero(1, problem.m())),
      stage_sums_(method.b, problem.m()),
      extrapolation_(P_.rows(), P_.cols()),
      sequence_(P_.size()),
      position_scale_(problem),
      positions_(problem.m()),
      // The lengths of the sums of one sweep, and 4 for what they are passed through, as roundings_of_a_sweep has it.
      rule_(problem.m(), static_cast<long>(4 * (3 * method.b.size() + problem.m()))),
      multiplier_(Vector<S>::Zero(problem.nu())),
      course_(problem, method.b.size()),
      arrival_(problem, 1),
      pull_(Matrix<S>::Zero(1, problem.nu())),
      lane_(force_),
      free_(problem.m()),
      before_(Vector<S>::Zero(problem.m()), Vector<S>::Zero(problem.m())) {
  const Index s = method.b.size();
  if (s < 1 || A_.rows() != s || A_.cols() != s) throw InputError("A must have as many rows and columns as b entries");
  if (problem.nu() > 0 || !problem.is_conservative()) point_.emplace(problem);
  if (problem.nu() > 0) {
    if (formulation.ends_on_constraints()) projection_.emplace(problem);
    if (formulation.on_constraints == OnConstraints::baumgarte)
      point_->stabilise(literal<S>(formulation.alpha.text()), literal<S>(formulation.beta.text()));
  }
  if (ggl_) {
    last_weight_ = method.b[s - 1];
    bool held = explicit_ && last_weight_ != 0;
    for (Index i = 1; i < s; ++i) held = held && A_(i, i - 1) != 0;
    if (!held)
      throw InputError(
          "+ggl takes an explicit method whose last weight and entries just below the diagonal are not 0, as " +
          std::string("euler, heun, rk4 or dopri5: they carry the multipliers"));
  }
  describe_parts();
}

template <Scalar S>
void RungeKuttaStepper<S>::describe_parts() {
  const Index s = A_.rows(), m = problem_.m(), used = (A_.array() != 0).count();
  parts_ = {{"stages"}, {"sums over stages"}};
  OperationCounts& stage = parts_[stages].per_call;
  stage = static_cast<std::uint64_t>(s) * problem_.mass.operations();
  stage.add(Op::multiply, 2 * m * s);
  stage.add(Op::add, 3 * m * s);  // the constant force is one
  if (explicit_)
    stage.add_products(2 * m * used);
  else
    stage.add_dots(2 * m * s, s);
  parts_[sums].per_call.add_dots(2 * m, s);
  parts_[sums].per_call.add(Op::multiply, 2 * m);
  parts_[sums].per_call.add(Op::add, 2 * m);
  if (point_) parts_.push_back({"constraint forces"});
}

template <Scalar S>
SolverCounts RungeKuttaStepper<S>::own_counts() const {
  SolverCounts now{potential_.counts(), parts_};
  if (projection_)
    now.parts.insert(now.parts.end(), projection_->part_counts().begin(), projection_->part_counts().end());
  return now;
}

template <Scalar S>
void RungeKuttaStepper<S>::remember_own(Archive& archive) {
  archive(h_, extrapolation_);
}

template <Scalar S>
void RungeKuttaStepper<S>::stages_in_turn(const State<S>& state) {
  const PartCall counted(parts_[stages]);
  const Index s = A_.rows(), m = problem_.m();
  const auto stage = [&](Index i, const Vector<S>& base, const Matrix<S>& slopes, Vector<S>& x) {
    for (Index j = 0; j < m; ++j) {
      set_zero(x[j]);
      for (Index l = 0; l < i; ++l)
        if (A_(i, l) != 0) add_product(x[j], A_(i, l), slopes(l, j), t_);
      set_product(x[j], h_, x[j]);
      set_sum(x[j], base[j], x[j]);
    }
  };
  for (Index i = 0; i < s; ++i) {
    stage(i, state.q, V_, q_);
    stage(i, state.p, F_, p_);
    if (ggl_) hold(i, q_, p_);
    if (problem_.is_conservative()) {
      problem_.mass.velocity(lanes(std::as_const(p_)), lanes(v_));
      potential_.force(lanes(std::as_const(q_)), force_);
    } else {
      point_->set_velocity(q_, p_, v_);
      point_->set_applied(q_, p_, force_);
    }
    if (problem_.nu() > 0 && !ggl_) add_constraint_force(q_, p_, force_, 0);
    for (Index j = 0; j < m; ++j) {
      set(V_(i, j), v_[j]);
      set(F_(i, j), force_(0, j));
    }
  }
}

template <Scalar S>
long RungeKuttaStepper<S>::solve(const State<S>& state) {
  position_scale_.evaluate(state.q, h_, positions_);
  Matrix<S> none;
  const long sweeps = find_stages(extrapolation_, sequence_, state.p, P_, none, [&] { return iterate(state); });
  extrapolation_.add(P_.data());
  problem_.mass.velocity(lanes(std::as_const(P_)), lanes(V_));
  course_.set_velocities(lanes(V_));
  return sweeps;
}

template <Scalar S>
void RungeKuttaStepper<S>::sweep(const State<S>& state) {
  const PartCall counted(parts_[stages]);
  problem_.mass.velocity(lanes(std::as_const(P_)), lanes(V_));
  course_.set_velocities(lanes(V_));
  product(Q_, A_, V_);
  scale_and_shift(Q_, h_, state.q);
  if (problem_.is_conservative()) potential_.force(lanes(std::as_const(Q_)), F_);
  for (Index i = 0; i < F_.rows() && point_; ++i) {
    for (Index j = 0; j < F_.cols(); ++j) {
      set(q_[j], Q_(i, j));
      set(p_[j], P_(i, j));
    }
    if (!problem_.is_conservative()) {
      point_->set_applied(q_, p_, force_);
      for (Index j = 0; j < F_.cols(); ++j) set(F_(i, j), force_(0, j));
    }
    if (problem_.nu() > 0) add_constraint_force(q_, p_, F_, i);
  }
  P_.swap(P_before_);
  product(P_, A_, F_);
  scale_and_shift(P_, h_, state.p);
  // Nothing depends on the momenta of driven coordinates.
  for (Index j = problem_.clock(); j < P_.cols(); ++j)
    for (Index i = 0; i < P_.rows(); ++i) set_zero(P_(i, j));
}

template <Scalar S>
long RungeKuttaStepper<S>::iterate(const State<S>& state) {
  return iterate_stages(rule_, state.p, positions_, h_, P_, P_before_, F_, [&] { sweep(state); });
}

template <Scalar S>
void RungeKuttaStepper<S>::add_constraint_force(const Vector<S>& Q, const Vector<S>& P, Matrix<S>& force, Index row) {
  const PartCall counted(parts_[pulls]);
  for (Index j = 0; j < force.cols(); ++j) set(lane_(0, j), force(row, j));
  try {
    const Vector<S>& pull = point_->constraint_force(Q, P, lane_);
    for (Index j = 0; j < force.cols(); ++j) set_sum(force(row, j), force(row, j), pull[j]);
  } catch (const IntegrationError& error) {
    throw StageFailure(FailureCause::near_singular_constraints, error.what(), "0", rule_.sweeps());
  }
}

template <Scalar S>
void RungeKuttaStepper<S>::hold(Index i, Vector<S>& q, Vector<S>& p) {
  if (i == 0) return projection_->set_directions(q);
  set_product(factor_, h_, A_(i, i - 1));
  set(free_, q);
  set_zero(pull_);
  projection_->find_position(free_, factor_, pull_, q);
  for (Index j = 0; j < q.size(); ++j) {
    set(v_[j], V_(i - 1, j));
    set(lane_(0, j), F_(i - 1, j));
  }
  projection_->directions().add_weighted_times(pull_, lanes(v_));
  const Matrix<S>& mu = projection_->make_tangential_along_directions(p);
  for (Index a = 0; a < mu.size(); ++a) {
    set_quotient(pull_(0, a), mu(0, a), factor_);
    set_negative(pull_(0, a), pull_(0, a));
  }
  projection_->directions().add_times(pull_, lanes(lane_));
  for (Index j = 0; j < q.size(); ++j) {
    set(V_(i - 1, j), v_[j]);
    set(F_(i - 1, j), lane_(0, j));
  }
  projection_->advance();
}

template <Scalar S>
void RungeKuttaStepper<S>::settle(State<S>& state) {
  if (problem_.nu() == 0) return;
  if (ggl_) {
    set_zero(pull_);
    set(q_, state.q);
    set_product(factor_, h_, last_weight_);
    projection_->find_position(q_, factor_, pull_, state.q);
    projection_->make_tangential_along_directions(state.p);
  } else if (projection_) {
    projection_->set_directions(state.q);
    set_zero(pull_);
    set(q_, state.q);
    projection_->find_position(q_, S(-1), pull_, state.q);
    projection_->make_tangential(state.p);
  }
  try {
    set(multiplier_, point_->multiplier(state.q, state.p));
  } catch (const IntegrationError& error) {
    throw StageFailure(FailureCause::near_singular_constraints, error.what(), "0", 0);
  }
}

template <Scalar S>
StepResult<S> RungeKuttaStepper<S>::step(State<S>& state, const S& h) {
  if (h != h_) {
    set(h_, h);
    extrapolation_.clear();
  }
  if (!course_.empty()) {
    for (Index i = 0; i < A_.rows(); ++i) course_.time(i) = state.q[problem_.clock()] + h_ * A_.row(i).sum();
    course_.evaluate();
  }
  long sweeps = 1;
  if (explicit_)
    stages_in_turn(state);
  else
    sweeps = solve(state);
  if (point_) copy_state(before_, state);
  try {
    {
      const PartCall counted(parts_[sums]);
      for (Index j = problem_.clock(); j < V_.cols(); ++j)
        for (Index i = 0; i < V_.rows(); ++i) set_zero(V_(i, j));
      stage_sums_.add_to(state, h_, V_, F_, sweeps);
      move_driven(state, h_, arrival_, problem_);
    }
    settle(state);
  } catch (const StageFailure&) {
    if (point_) copy_state(state, before_);
    throw;
  }
  return {sweeps, &multiplier_};
}

#define HBVM_DEFINE(S) template class RungeKuttaStepper<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

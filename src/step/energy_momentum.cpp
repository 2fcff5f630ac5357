#include "step/energy_momentum.hpp"

#include "linear/arrays.hpp"
#include "scalar/in_place.hpp"

namespace hbvm::core {

template <Scalar S>
EnergyMomentum<S>::EnergyMomentum(const Problem<S>& problem)
    : problem_(problem),
      one_half_(S(1) / 2),
      force_(problem.potential),
      middle_gradient_(problem, 1),
      end_gradient_(problem, 1),
      P_(Matrix<S>::Zero(1, problem.m())),
      P_before_(P_),
      V_(P_),
      F_(P_),
      q1_(problem.m()),
      middle_(problem.m()),
      lambda_(Matrix<S>::Zero(1, problem.nu())),
      pull_(lambda_),
      g_(lambda_),
      x_(problem.nu()),
      sums_(Vector<S>::Constant(1, S(1)), problem.m()),
      extrapolation_(1, problem.m() + problem.nu()),
      sequence_(problem.m() + problem.nu()),
      position_scale_(problem),
      positions_(problem.m()),
      // The lengths of the sums of one sweep, and 4 for what they are passed through.
      rule_(problem.m(), static_cast<long>(4 * (3 + problem.m() + problem.nu()))),
      multiplier_(Vector<S>::Zero(problem.nu())) {
  std::vector<std::pair<Index, Index>> entries;
  for (const auto& pair : end_gradient_.couplings()) entries.emplace_back(pair.a, pair.b);
  order_ = order_for_band(problem.nu(), entries);
  system_.resize(problem.nu(), order_.half_bandwidth);
  describe_parts();
}

template <Scalar S>
void EnergyMomentum<S>::describe_parts() {
  const Index m = problem_.m(), nu = problem_.nu();
  parts_ = {{"midpoint and momenta"},
            {"constraint gradients"},
            {"matrix of multipliers"},
            {"factors of it"},
            {"multipliers"}};
  parts_[motion].per_call = problem_.mass.operations();
  parts_[motion].per_call.add_products(3 * m);
  parts_[motion].per_call += middle_gradient_.times_operations();
  parts_[gradients].per_call = end_gradient_.operations() + end_gradient_.weighing_operations();
  for (const auto& pair : end_gradient_.couplings()) parts_[matrix].per_call.add_dots(1, pair.products);
  parts_[factors].per_call = system_.factor_operations();
  parts_[solution].per_call = system_.solve_operations();
  parts_[solution].per_call.add(Op::reciprocal, nu);
  parts_[solution].per_call.add(Op::add, nu);
  parts_[solution].per_call += middle_gradient_.times_operations();
}

template <Scalar S>
SolverCounts EnergyMomentum<S>::own_counts() const {
  return SolverCounts{force_.counts(), parts_};
}

template <Scalar S>
void EnergyMomentum<S>::remember_own(Archive& archive) {
  archive(h_, extrapolation_);
  if (!archive.reading()) return;
  set_product(half_, h_, one_half_);
}

template <Scalar S>
void EnergyMomentum<S>::move(const Vector<S>& q0) {
  for (Index j = 0; j < q0.size(); ++j) {
    set_product(middle_[j], half_, V_(0, j));
    set_sum(middle_[j], middle_[j], q0[j]);
    set_product(q1_[j], h_, V_(0, j));
    set_sum(q1_[j], q1_[j], q0[j]);
  }
}

template <Scalar S>
bool EnergyMomentum<S>::correct_multipliers() {
  // Let G = grad g in the middle: then h G^T v is g(q_1) - g(q_0). It changes by h times the gradient at q_1 with v,
  // and v by -h/2 M^-1 G with lambda. The matrix near the solution serves all sweeps: it multiplies a residual that
  // goes to 0. The first start has no multipliers: one sweep finds them, a second the positions they lead to, a third
  // has its matrix there.
  constexpr long near = 3;
  if (rule_.sweeps() < near) {
    {
      const PartCall counted(parts_[gradients]);
      end_gradient_.update(lanes(std::as_const(q1_)), g_);
    }
    {
      const PartCall counted(parts_[matrix]);
      system_.set_zero();
      end_gradient_.for_each_coupling(middle_gradient_, &product_, [&](const auto& pair) {
        set(system_.entry(place(pair.a), place(pair.b)), product_);
      });
    }
    const PartCall counted(parts_[factors]);
    if (!system_.factor()) return false;
  }
  const PartCall counted(parts_[solution]);
  for (Index a = 0; a < lambda_.cols(); ++a) {
    S& x = x_[place(a)];
    middle_gradient_.transposed_times(a, lanes(std::as_const(V_)), &x);
    set_quotient(x, x, half_);
  }
  system_.solve(x_);
  for (Index a = 0; a < lambda_.cols(); ++a) {
    set_sum(lambda_(0, a), lambda_(0, a), x_[place(a)]);
    set_negative(pull_(0, a), lambda_(0, a));
  }
  return true;
}

template <Scalar S>
void EnergyMomentum<S>::sweep(const State<S>& state) {
  {
    const PartCall counted(parts_[motion]);
    problem_.mass.velocity(lanes(std::as_const(P_)), lanes(V_));
    move(state.q);
  }
  force_.evaluate(state.q, q1_, F_);
  if (problem_.nu() > 0) {
    {
      const PartCall counted(parts_[gradients]);
      middle_gradient_.update(lanes(std::as_const(middle_)));
    }
    if (!correct_multipliers())
      throw StageFailure(FailureCause::near_singular_constraints,
                         "the linear system for the multipliers of the step is singular", "0", rule_.sweeps() + 1);
    middle_gradient_.add_times(pull_, lanes(F_));
  }
  P_.swap(P_before_);
  for (Index j = 0; j < P_.cols(); ++j) {
    set_product(P_(0, j), half_, F_(0, j));
    set_sum(P_(0, j), P_(0, j), state.p[j]);
  }
}

template <Scalar S>
long EnergyMomentum<S>::iterate(const State<S>& state) {
  return iterate_stages(rule_, state.p, positions_, h_, P_, P_before_, F_, [&] { sweep(state); });
}

template <Scalar S>
long EnergyMomentum<S>::solve(const State<S>& state) {
  position_scale_.evaluate(state.q, h_, positions_);
  return find_stages(extrapolation_, sequence_, state.p, P_, lambda_, [&] { return iterate(state); });
}

template <Scalar S>
StepResult<S> EnergyMomentum<S>::step(State<S>& state, const S& h) {
  if (h != h_) {
    set(h_, h);
    set_product(half_, h, one_half_);
    extrapolation_.clear();
  }
  const long sweeps = solve(state);
  problem_.mass.velocity(lanes(std::as_const(P_)), lanes(V_));
  sums_.add_to(state, h_, V_, F_, sweeps);
  extrapolation_.add(sequence_.data());
  for (Index a = 0; a < multiplier_.size(); ++a) set(multiplier_[a], lambda_(0, a));
  return {sweeps, &multiplier_};
}

namespace {

class EnergyMomentumMethod final : public MethodByTemplate<EnergyMomentumMethod> {
 public:
  std::string text() const override { return "energy_momentum"; }
  std::string title() const override { return "energy-momentum"; }
  int order() const override { return 2; }
  int stages() const override { return 1; }
  int terms() const override { return 2; }
  Kept kept() const override {
    return {.energy = true, .momenta = true, .constraints = true, .hidden = false, .reversal = true};
  }
  Orders orders() const override { return {.p = 2, .lambda = 1, .hidden = 2}; }
  template <Scalar S>
  StepperMaker<S> prepare_in(const Problem<S>& problem, SolverKind) const {
    require_conservative(problem, text());
    if (degree(problem.constraints) != 2)
      throw InputError(
          "method energy_momentum takes quadratic constraints alone, whose discrete derivative is the gradient half "
          "way; "
          "use hbvm:K,S,R");
    return [&problem] { return std::make_unique<EnergyMomentum<S>>(problem); };
  }
};

}  // namespace

MethodPtr energy_momentum_method() { return std::make_shared<const EnergyMomentumMethod>(); }

#define HBVM_DEFINE(S) template class EnergyMomentum<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

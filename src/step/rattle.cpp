#include "step/rattle.hpp"

#include "linear/arrays.hpp"
#include "scalar/in_place.hpp"

namespace hbvm::core {

template <Scalar S>
Rattle<S>::Rattle(const Problem<S>& problem, Kicks kicks)
    : problem_(problem),
      is_halved_(kicks == Kicks::two_halves),
      one_half_(S(1) / 2),
      potential_(problem.potential, 1),
      projection_(problem),
      force_(Matrix<S>::Zero(1, problem.m())),
      lambda_(Matrix<S>::Zero(1, problem.nu())),
      pull_(lambda_),
      free_(problem.m()),
      q_(problem.m()),
      p_(problem.m()),
      v_(problem.m()),
      multiplier_(Vector<S>::Zero(problem.nu())),
      arrived_(problem.m()) {
  kicks_.per_call = problem.mass.operations();
  kicks_.per_call.add_products(3 * problem.m());
  kicks_.per_call.add(Op::multiply, problem.nu());
  kicks_.per_call.add(Op::negate, problem.nu());
  kicks_.per_call += projection_.directions().times_operations();
}

template <Scalar S>
SolverCounts Rattle<S>::own_counts() const {
  SolverCounts now{potential_.counts(), {kicks_}};
  now.parts.insert(now.parts.end(), projection_.part_counts().begin(), projection_.part_counts().end());
  return now;
}

template <Scalar S>
void Rattle<S>::remember_own(Archive& archive) {
  archive(lambda_);
  if (archive.reading()) started_ = false;
}

template <Scalar S>
void Rattle<S>::arrive(const Vector<S>& q) {
  if (started_ && q == arrived_) return;
  potential_.force(lanes(q), force_);
  projection_.set_directions(q);
  started_ = true;
}

template <Scalar S>
void Rattle<S>::kick_and_drift(const State<S>& state) {
  const PartCall counted(kicks_);
  for (Index j = 0; j < p_.size(); ++j) {
    set_product(p_[j], kick_, force_(0, j));
    set_sum(p_[j], p_[j], state.p[j]);
  }
  problem_.mass.velocity(lanes(std::as_const(p_)), lanes(v_));
  for (Index j = 0; j < q_.size(); ++j) {
    set_product(free_[j], h_, v_[j]);
    set_sum(free_[j], free_[j], state.q[j]);
  }
}

template <Scalar S>
void Rattle<S>::kick_back() {
  for (Index j = 0; is_halved_ && j < p_.size(); ++j) {
    set_product(v_[j], kick_, force_(0, j));
    set_sum(p_[j], p_[j], v_[j]);
  }
  for (Index a = 0; a < pull_.size(); ++a) {
    set_product(pull_.data()[a], kick_, lambda_.data()[a]);
    set_negative(pull_.data()[a], pull_.data()[a]);
  }
  projection_.directions().add_times(pull_, lanes(p_));
}

template <Scalar S>
StepResult<S> Rattle<S>::step(State<S>& state, const S& h) {
  if (h != h_) {
    set(h_, h);
    if (is_halved_)
      set_product(kick_, h, one_half_);
    else
      set(kick_, h);
    set_product(factor_, h, kick_);
    set_negative(factor_, factor_);
  }
  arrive(state.q);
  kick_and_drift(state);
  long iterations = 0;
  try {
    iterations = projection_.find_position(free_, factor_, lambda_, q_);
    // From here on force_ is that at q_1.
    started_ = false;
    potential_.force(lanes(std::as_const(q_)), force_);
    kick_back();
    if (problem_.nu() > 0) {
      const Matrix<S>& mu = projection_.make_tangential(p_);
      for (Index a = 0; a < multiplier_.size(); ++a) {
        set_quotient(multiplier_[a], mu.data()[a], kick_);
        if (!is_halved_) set_sum(multiplier_[a], multiplier_[a], lambda_.data()[a]);
      }
    }
    for (Index j = 0; j < q_.size(); ++j)
      if (!is_finite(q_[j]) || !is_finite(p_[j]))
        throw StageFailure(FailureCause::stage_equations_diverge, "a RATTLE step is not finite", "inf", iterations);
  } catch (const StageFailure&) {
    lambda_.setZero();
    throw;
  }
  set(arrived_, q_);
  state.q.swap(q_);
  state.p.swap(p_);
  projection_.advance();
  started_ = true;
  return {iterations, &multiplier_};
}

namespace {

class RattleMethod final : public MethodByTemplate<RattleMethod> {
 public:
  explicit RattleMethod(Kicks kicks) : kicks_(kicks) {}

  std::string text() const override { return is_halved() ? "rattle" : "symplectic_euler"; }
  std::string title() const override { return is_halved() ? "RATTLE" : "symplectic Euler"; }
  int order() const override { return is_halved() ? 2 : 1; }
  int stages() const override { return 1; }
  int terms() const override { return 2; }
  Kept kept() const override {
    return {.energy = false, .momenta = true, .constraints = true, .hidden = true, .reversal = is_halved()};
  }
  template <Scalar S>
  StepperMaker<S> prepare_in(const Problem<S>& problem, SolverKind) const {
    require_conservative(problem, text());
    return [&problem, kicks = kicks_] { return std::make_unique<Rattle<S>>(problem, kicks); };
  }

 private:
  bool is_halved() const { return kicks_ == Kicks::two_halves; }

  Kicks kicks_;
};

}  // namespace

MethodPtr rattle_method() { return std::make_shared<const RattleMethod>(Kicks::two_halves); }
MethodPtr symplectic_euler_method() { return std::make_shared<const RattleMethod>(Kicks::one_whole); }

#define HBVM_DEFINE(S) template class Rattle<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

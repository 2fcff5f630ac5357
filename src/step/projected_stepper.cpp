#include "step/projected_stepper.hpp"

#include <algorithm>

#include "copy_state.hpp"
#include "linear/arrays.hpp"
#include "scalar/text.hpp"
#include "step/add_compensated.hpp"
#include "step/hbvm_method.hpp"

namespace hbvm::core {

template <Scalar S>
ProjectedStepper<S>::ProjectedStepper(std::unique_ptr<Stepper<S>> inner, OnEnergy on_energy)
    : ForwardingStepper<S>(std::move(inner)),
      on_energy_(on_energy),
      projection_(problem()),
      energy_(problem()),
      before_(Vector<S>::Zero(problem().m()), Vector<S>::Zero(problem().m())),
      p_(before_.p),
      v_(before_.p),
      made_q_(before_.p),
      made_p_(before_.p) {
  const Problem<S>& of = problem();
  OperationCounts& counts = scaling_.per_call = std::uint64_t{2} * of.mass.operations();
  for (const EffectTerm<S>& term : of.potential.terms) {
    for (const Displacement<S>& x : term.displacements) counts += operations(x, of.dimension);
    counts += static_cast<std::uint64_t>(term.instances()) * term.value.operations();
  }
  counts.add_products(3 * of.m());
  counts.add(Op::reciprocal, 2);
  counts.add(Op::sqrt, 1);
}

template <Scalar S>
SolverCounts ProjectedStepper<S>::own_counts() const {
  SolverCounts now{std::vector<EffectCount>(problem().potential.terms.size() + problem().forces.size()),
                   projection_.part_counts()};
  if (on_energy_ == OnEnergy::restore) now.parts.push_back(scaling_);
  return sum_of(now, earlier_, problem());
}

template <Scalar S>
SolverCounts ProjectedStepper<S>::counts() const {
  return sum_of(ForwardingStepper<S>::counts(), own_counts(), problem());
}

template <Scalar S>
void ProjectedStepper<S>::remember(Archive& archive) {
  SolverCounts own = own_counts();
  ForwardingStepper<S>::remember(archive);
  archive(own, made_q_, made_p_, H_, started_);
  if (archive.reading()) earlier_ = std::move(own);
}

template <Scalar S>
void ProjectedStepper<S>::take_energy(const State<S>& state) {
  if (started_ && state.q == made_q_ && state.p == made_p_) return;
  const PartCall counted(scaling_);
  energy_.evaluate_energy(state.q, state.p);
  set(H_, energy_.H());
  started_ = true;
}

template <Scalar S>
void ProjectedStepper<S>::project(State<S>& state) {
  if (problem().nu() == 0) return;
  projection_.set_position(state.q);
  for (Index j = 0; j < p_.size(); ++j) set(p_[j], state.p[j]);
  projection_.make_tangential(p_);
  for (Index j = 0; j < p_.size(); ++j) {
    set_difference(change_, p_[j], state.p[j]);
    add_compensated(state.p[j], state.p_carry[j], change_, s_, t_);
  }
}

template <Scalar S>
void ProjectedStepper<S>::restore(State<S>& state) {
  const PartCall counted(scaling_);
  energy_.evaluate_energy(state.q, state.p);
  problem().mass.velocity(lanes(std::as_const(state.p)), lanes(v_));
  S T = 0;
  for (Index j = 0; j < v_.size(); ++j) add_product(T, state.p[j], v_[j], t_);
  T /= 2;
  const S missing = H_ - energy_.H();
  if (missing == 0) return;
  using std::sqrt;
  const S share = missing / T;
  if (!(share > -1) || !is_finite(share))
    throw StageFailure(FailureCause::precision_exhausted,
                       "H cannot be restored by scaling the momenta: " + to_scientific(missing, 3) +
                           " is missing beside a kinetic energy of " + to_scientific(T, 3),
                       to_scientific(missing, 3), 0);
  // sqrt(1 + share) - 1
  const S factor = share / (1 + sqrt(S(1 + share)));
  for (Index j = 0; j < problem().mass.of_bodies(); ++j) {
    set_product(change_, factor, state.p[j]);
    add_compensated(state.p[j], state.p_carry[j], change_, s_, t_);
  }
}

template <Scalar S>
StepResult<S> ProjectedStepper<S>::step(State<S>& state, const S& h) {
  if (on_energy_ == OnEnergy::restore) take_energy(state);
  copy_state(before_, state);
  const StepResult<S> result = this->inner().step(state, h);
  try {
    project(state);
    if (on_energy_ == OnEnergy::restore) restore(state);
  } catch (const StageFailure& failure) {
    copy_state(state, before_);
    throw StageFailure(failure.cause(), failure.what(), failure.increment(), result.sweeps);
  }
  set(made_q_, state.q);
  set(made_p_, state.p);
  return result;
}

namespace {

/// HBVM(k,s), its state projected.
class ProjectedHbvm final : public MethodByTemplate<ProjectedHbvm> {
 public:
  ProjectedHbvm(HbvmName name, OnEnergy on_energy) : inner_(name), on_energy_(on_energy) {}

  std::string text() const override { return std::string(restores() ? "restored" : "projected") + "_" + inner_.text(); }
  std::string title() const override {
    return inner_.title() + (restores() ? ", projected, H restored" : ", projected");
  }
  int order() const override { return inner_.order(); }
  int stages() const override { return inner_.stages(); }
  int terms() const override { return inner_.terms() + 1; }
  Kept kept() const override {
    return {.energy = restores(),
            .momenta = !restores() && inner_.kept().momenta,
            .constraints = true,
            .hidden = true,
            .reversal = false};
  }
  /// A step leaves the tangent space by O(h^(s+1)), whose kinetic energy is O(h^(2s+2)). So the energy that is lost or
  /// made up for is O(h^(2s+1)) over an interval, beside that of the nodes.
  Orders orders() const override {
    const int k = inner_.name().k, s = inner_.name().s;
    const int lost = 2 * s + 1;
    return {.p = 2 * s,
            .lambda = s,
            .energy = restores() ? 0 : std::min(2 * k, lost),
            .angular_momentum = kept().momenta ? 0 : 2 * s};
  }
  Constants parameters() const override { return inner_.parameters(); }
  template <Scalar S>
  StepperMaker<S> prepare_in(const Problem<S>& problem, SolverKind solver) const {
    return [inner = inner_.prepare_in(problem, solver), on_energy = on_energy_] {
      return std::make_unique<ProjectedStepper<S>>(inner(), on_energy);
    };
  }

 private:
  bool restores() const { return on_energy_ == OnEnergy::restore; }

  HbvmMethod inner_;
  OnEnergy on_energy_;
};

MethodPtr projected_hbvm(std::string_view arguments, OnEnergy on_energy, const std::string& family) {
  const std::string all = "method " + family + ":" + std::string(arguments) + ": ";
  std::optional<HbvmName> name;
  try {
    name = HbvmName::parse("hbvm:" + std::string(arguments));
  } catch (const InputError&) {
    throw InputError(all + "use " + family + ":K,S with whole numbers K >= S >= 1");
  }
  if (name->is_auto()) throw InputError(all + "K is to be said; hbvm:auto,S alone chooses it");
  return std::make_shared<const ProjectedHbvm>(*name, on_energy);
}

}  // namespace

MethodPtr projected_hbvm_method(std::string_view arguments) {
  return projected_hbvm(arguments, OnEnergy::lose, "projected_hbvm");
}
MethodPtr restored_hbvm_method(std::string_view arguments) {
  return projected_hbvm(arguments, OnEnergy::restore, "restored_hbvm");
}

#define HBVM_DEFINE(S) template class ProjectedStepper<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

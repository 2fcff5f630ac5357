#include "reference/taylor_method.hpp"

#include "hbvm/error.hpp"
#include "interruption.hpp"
#include "linear/arrays.hpp"
#include "reference/taylor.hpp"
#include "scalar/in_place.hpp"
#include "step/registry.hpp"

namespace hbvm::core {
namespace {

class TaylorStepper final : public CountingStepper<Mpfr> {
 public:
  explicit TaylorStepper(const Problem<Mpfr>& problem)
      : problem_(problem),
        multiplier_(Vector<Mpfr>::Zero(problem.nu())),
        effects_(problem.potential.terms.size() + problem.forces.size()) {}

  const Problem<Mpfr>& problem() const override { return problem_; }

  /// \return steps of the series
  StepResult<Mpfr> step(State<Mpfr>& state, const Mpfr& h) override {
    const PartCall counted(series_);
    if (h < 0)
      throw InputError("method taylor goes back in time where all forces have a potential, and t does not occur");
    try {
      TaylorMotion motion(problem_, state.q, state.p, [] { end_if_asked("a step is made of many"); });
      motion.advance_to(h);
      const auto steps = static_cast<std::uint64_t>(motion.steps() + 1);
      for (auto& effect : effects_) {
        effect.calls += steps;
        effect.evaluations += steps * static_cast<std::uint64_t>(motion.order());
      }
      set(state.q, motion.q());
      set(state.p, motion.p());
      set_zero(state.q_carry);
      set_zero(state.p_carry);
      if (problem_.nu() > 0) set(multiplier_, motion.lambda());
      return {static_cast<long>(steps), &multiplier_};
    } catch (const IntegrationError& error) {
      throw StageFailure(FailureCause::stage_equations_diverge,
                         std::string("from the start of the step, ") + error.what(), "inf", 0);
    }
  }

 private:
  /// The evaluations of an effect are coefficients of the series of its force.
  SolverCounts own_counts() const override { return {effects_, {series_}}; }
  void remember_own(Archive&) override {}

  const Problem<Mpfr>& problem_;
  Vector<Mpfr> multiplier_;
  std::vector<EffectCount> effects_;
  PartCount series_{"Taylor series"};
};

class TaylorMethod final : public MethodByTemplate<TaylorMethod> {
 public:
  std::string text() const override { return "taylor"; }
  std::string title() const override { return "Taylor series"; }
  /// Of a method it is compared with: its own is some 0.6 of the bits.
  int order() const override { return 30; }
  int stages() const override { return 15; }
  int terms() const override { return 30; }
  /// To round-off, as it finds everything.
  Kept kept() const override {
    return {.energy = true, .momenta = true, .constraints = true, .hidden = true, .reversal = true};
  }
  /// As many as there are; claims are decided with so many, and some more.
  std::optional<int> digits() const override { return 40; }

  template <Scalar S>
  StepperMaker<S> prepare_in(const Problem<S>& problem, SolverKind) const {
    if constexpr (std::same_as<S, Mpfr>)
      return [&problem] { return std::make_unique<TaylorStepper>(problem); };
    else
      throw InputError("method taylor computes its series with MPFR: say --precision mpfr:DIGITS");
  }
};

}  // namespace

MethodPtr taylor_method() { return std::make_shared<const TaylorMethod>(); }

void add_taylor_method() {
  add_method_family({.name = "taylor",
                     .form = "taylor",
                     .make = [](const MethodSpec&) { return taylor_method(); },
                     .example = "taylor",
                     .order = "follows from the digits",
                     .work = "the Taylor series of the motion",
                     .note = "to round-off in each step, with MPFR alone"});
}

}  // namespace hbvm::core

#include "run/choose_k.hpp"

#include <algorithm>

#include "integrate/integrate.hpp"
#include "interruption.hpp"
#include "problem/effect/trace.hpp"
#include "problem/general_drift.hpp"
#include "scalar/text.hpp"
#include "step/quadrature_defect.hpp"

namespace hbvm::core {

template <Scalar S>
std::optional<int> degree_of_U(const Problem<S>& problem) {
  int degree = 0;
  for (const auto& term : problem.potential.terms) {
    std::set<Index> own;
    for (const auto& x : term.displacements) own.merge(coordinates(x, problem.dimension));
    if (term.degree < 0 || follows_course(problem, own)) return std::nullopt;
    degree = std::max(degree, term.degree);
  }
  return degree;
}

namespace {

constexpr int first_steps = 16;

/// The first steps with k nodes, up to one that fails or whose defect is no round-off.
template <Scalar S>
struct Trial {
  int k = 0, made = 0;
  S defect = 0;                         ///< the worst of the steps made
  S relative = 0;                       ///< the same, over the forces' size alone
  S g_units = 0;                        ///< the most that one of them moved g that is to be kept, in units of round-off
  bool may_be_round_off = true;         ///< all of them
  std::optional<StageFailure> failure;  ///< of the step after those made

  bool is_complete() const { return made == first_steps && may_be_round_off; }
};

template <Scalar S>
Trial<S> try_nodes(const Assembled<S>& scene, const HbvmName& name, bool keeps_g, const S& step, SolverKind solver) {
  const auto [k, s, r] = name;
  Trial<S> trial;
  trial.k = k;
  const Hbvm<S> method = make_hbvm<S>(k, s, r);
  GeneralDrift<S> drift(scene.problem);
  HbvmStepper<S> stepper(scene.problem, method, solver);
  QuadratureDefect<S> defect(scene.problem, k, s);
  State<S> state(scene.q0, scene.p0);
  try {
    for (; trial.made < first_steps && trial.may_be_round_off; ++trial.made) {
      end_if_asked("the nodes of the method were not chosen");
      const Vector<S> q = state.q, p = state.p;
      stepper.step(state, step);
      raise_to(trial.defect, defect.measure({q, p, step}, stepper.solver().unknowns()));
      raise_to(trial.relative, defect.relative());
      trial.may_be_round_off = defect.may_be_round_off();
      if (!keeps_g) continue;
      drift.start(q);
      const S moved = drift.in_units(state.q);
      raise_to(trial.g_units, moved);
      trial.may_be_round_off = trial.may_be_round_off && moved * moved * epsilon<S>() < 1;
    }
  } catch (const StageFailure& failure) {
    trial.failure = failure;
  }
  return trial;
}

}  // namespace

template <Scalar S>
S quadrature_defect(const Problem<S>& problem, int k, int s, const S& step, SolverKind solver, const Vector<S>& q,
                    const Vector<S>& p) {
  const Hbvm<S> method = make_hbvm<S>(k, s);
  HbvmStepper<S> stepper(problem, method, solver);
  State<S> state(q, p);
  stepper.step(state, step);
  return QuadratureDefect<S>(problem, k, s).measure({q, p, step}, stepper.solver().unknowns());
}

template <Scalar S>
ChosenK choose_k(const Assembled<S>& scene, const HbvmName& name, const S& step, SolverKind solver) {
  const int s = name.s;
  const std::optional<int> of_U = degree_of_U(scene.problem);
  const int of_g = degree_of_g(scene.problem);
  const bool general = of_g != 2, tries_r = of_g == Trace<S>::not_polynomial && name.r == 0;
  const auto nodes = [&](int n) {
    return HbvmName{of_U ? exact_nodes(*of_U, s) : n, s, name.r != 0 ? name.r : tries_r ? n : exact_nodes(of_g, s)};
  };
  const auto chosen = [&](int n, const std::string& why) {
    const HbvmName of = nodes(n);
    of.check();
    std::string reason = why;
    if (tries_r)
      reason += "; g is not a polynomial: " + std::string(of_U ? "the least r" : "as many r, which are the least") +
                " that keep it to round-off over these steps";
    else if (general && name.r == 0)
      reason += "; g is a polynomial of degree " + std::to_string(of_g) + ": r >= " + std::to_string(of_g) +
                "/2 s keeps it exactly";
    return ChosenK{of.k, reason, of_U && !tries_r, general || name.r != 0 ? of.r : 0,
                   tries_r ? Raises::k_and_r : Raises::k};
  };
  const std::string of_polynomial = of_U ? "U is a polynomial of degree " + std::to_string(*of_U) +
                                               (*of_U <= 2 ? ": k = s" : ": k >= " + std::to_string(*of_U) + "/2 s") +
                                               " conserves energy exactly"
                                         : "";
  if (of_U && !tries_r) return chosen(s, of_polynomial);
  const auto attempt = [&](int n) {
    Trial<S> trial = try_nodes(scene, nodes(n), tries_r, step, solver);
    trial.k = n;
    return trial;
  };
  // Doubling finds an upper bound, bisection the least: more nodes never do worse. A k whose steps fail is not enough.
  // If those of `patience` k in a row do and none came farther than the one before, all will. Where a defect that may
  // be round-off does not fall, it is: twice as much is then tolerated.
  constexpr int patience = 3;
  const int most = max_k - s;
  constexpr int roundings_of_g = 1;  // a unit of the sizes of g and of q at either end
  S noise = 0, noise_of_g = roundings_of_g;
  const auto passes = [&](const Trial<S>& trial) {
    return (trial.defect <= 1 || trial.relative <= noise) && trial.g_units <= noise_of_g;
  };
  const auto enough = [&](const Trial<S>& trial) { return trial.is_complete() && passes(trial); };
  Trial<S> trial = attempt(s);
  std::optional<Trial<S>> farthest;  // of those that end with a failure, and are sound before
  int low = s, high = s, in_vain = 0;
  const auto count_failure = [&] {
    const bool farther = passes(trial) && (!farthest || trial.made > farthest->made);
    in_vain = trial.failure && !farther ? in_vain + 1 : 0;
    if (trial.failure && farther) farthest = trial;
  };
  count_failure();
  while (!enough(trial) && high < most && in_vain < patience) {
    low = high + 1;
    high = std::min(2 * high, most);
    const Trial<S> last = trial;
    trial = attempt(high);
    count_failure();
    if (trial.is_complete() && last.is_complete() && trial.relative * 2 > last.relative &&
        2 * trial.g_units >= last.g_units && !enough(trial)) {
      noise = std::max(last.relative, trial.relative) * 2;
      raise_to(noise_of_g, S(std::max(last.g_units, trial.g_units) * 2));
      low = s;
      high = last.k;
      trial = last;
    }
  }
  if (!enough(trial)) {
    if (!trial.failure)
      throw InputError("method " + name.text() + ": no " + (of_U ? "r" : "k") + " up to " + std::to_string(most) +
                       " reaches round-off; " + (of_U ? "g" : "U") +
                       " is not smooth where the motion leads, or the step is too large");
    if (!farthest || farthest->made == 0)
      throw StepError(trial.made + 1, to_text(S(S(trial.made) * step)), *trial.failure);
    const char* const which = of_U ? "r" : "k";
    return chosen(farthest->k, (of_U ? of_polynomial + "; no " : std::string("U is not a polynomial, and no ")) +
                                   which + " makes more than the first " + std::to_string(farthest->made) + " steps");
  }
  while (low < high) {
    const int middle = (low + high) / 2;
    if (enough(attempt(middle)))
      high = middle;
    else
      low = middle + 1;
  }
  return chosen(high, of_U ? of_polynomial
                           : "U is not a polynomial: the least k whose force coefficients agree with those of k + s to "
                             "round-off over the first " +
                                 std::to_string(first_steps) + " steps");
}

#define HBVM_DEFINE(S)                                                                                 \
  template std::optional<int> degree_of_U<S>(const Problem<S>&);                                       \
  template ChosenK choose_k<S>(const Assembled<S>&, const HbvmName&, const S&, SolverKind);            \
  template S quadrature_defect<S>(const Problem<S>&, int, int, const S&, SolverKind, const Vector<S>&, \
                                  const Vector<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

#include "hbvm/analysis/choose_k.hpp"

#include <algorithm>

#include "hbvm/integrate/integrate.hpp"
#include "hbvm/scalar/text.hpp"

namespace hbvm {

template <Scalar S>
std::optional<int> degree_of_U(const Problem<S>& problem) {
  int degree = 0;
  for (const auto& term : problem.potential.terms) {
    if (term.degree < 0) return std::nullopt;
    degree = std::max(degree, term.degree);
  }
  return degree;
}

namespace {

/// The defect at the step that `stepper`, of method (k, s), has just made from (q, p).
template <Scalar S>
S defect_after(HbvmStepper<S>& stepper, int k, int s, const S& step, const Vector<S>& q, const Vector<S>& p) {
  const Problem<S>& problem = stepper.problem();
  const StageUnknowns<S>& x = stepper.solver().unknowns();
  const Hbvm<S> methods[2] = {make_hbvm<S>(k, s), make_hbvm<S>(k + s, s)};
  Matrix<S> psi[2] = {x.psi, x.psi};
  for (int i = 0; i < 2; ++i) {
    StageEquations<S> equations(problem, methods[i], step);
    equations.start(q, p);
    equations.move(x.gamma);
    equations.forces(psi[i]);
  }
  // psi_0 is the mean force; the sums of k products behind it carry k roundings, and the positions' round-off, relative
  // to the step's displacement, comes on top.
  S size = max_norm(psi[1]);
  raise_to(size, max_norm(x.zeta));
  const S round_off = S(16 * (k + s)) * epsilon<S>() * size;
  const S difference = max_norm(Matrix<S>(psi[0] - psi[1]));
  return difference == 0 ? S(0) : S(difference / round_off);
}

}  // namespace

template <Scalar S>
S quadrature_defect(const Problem<S>& problem, int k, int s, const S& step, SolverKind solver, const Vector<S>& q,
                    const Vector<S>& p) {
  const Hbvm<S> method = make_hbvm<S>(k, s);
  HbvmStepper<S> stepper(problem, method, step, solver);
  State<S> state(q, p);
  stepper.step(state);
  return defect_after(stepper, k, s, step, q, p);
}

template <Scalar S>
ChosenK choose_k(const Assembled<S>& scene, int s, const S& step, SolverKind solver) {
  if (const auto degree = degree_of_U(scene.problem)) {
    const int k = std::max(s, (*degree * s + 1) / 2);
    MethodName{k, s}.check();
    return {k, "U is a polynomial of degree " + std::to_string(*degree) +
                   (*degree <= 2 ? ": k = s" : ": k >= " + std::to_string(*degree) + "/2 s") +
                   " conserves energy exactly"};
  }
  constexpr int first_steps = 16;
  const auto enough = [&](int k) {
    const Hbvm<S> method = make_hbvm<S>(k, s);
    HbvmStepper<S> stepper(scene.problem, method, step, solver);
    State<S> state(scene.q0, scene.p0);
    for (int n = 0; n < first_steps; ++n) {
      const Vector<S> q = state.q, p = state.p;
      try {
        stepper.step(state);
      } catch (const StageFailure& failure) {
        throw StepError(n + 1, to_text(S(S(n) * step)), failure);
      }
      if (!(defect_after(stepper, k, s, step, q, p) <= 1)) return false;
    }
    return true;
  };
  // Doubling finds an upper bound, bisection the least: more nodes never do worse.
  const int most = max_k - s;
  int low = s, high = s;
  while (!enough(high)) {
    if (high == most)
      throw InputError("method hbvm:auto," + std::to_string(s) + ": no k up to " + std::to_string(most) +
                       " reaches round-off; U is not smooth where the motion leads, or the step is too large");
    low = high + 1;
    high = std::min(2 * high, most);
  }
  while (low < high) {
    const int middle = (low + high) / 2;
    if (enough(middle))
      high = middle;
    else
      low = middle + 1;
  }
  return {high,
          "U is not a polynomial: the least k whose psi_hat agrees with that of k + s to round-off over the first " +
              std::to_string(first_steps) + " steps"};
}

#define HBVM_DEFINE(S)                                                                                 \
  template std::optional<int> degree_of_U<S>(const Problem<S>&);                                       \
  template ChosenK choose_k<S>(const Assembled<S>&, int, const S&, SolverKind);                        \
  template S quadrature_defect<S>(const Problem<S>&, int, int, const S&, SolverKind, const Vector<S>&, \
                                  const Vector<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm

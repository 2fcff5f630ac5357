#include "trial.hpp"

#include "basis/gauss_legendre.hpp"
#include "basis/legendre.hpp"
#include "integrate/between_steps.hpp"
#include "linear/rounded.hpp"
#include "step/hbvm_method.hpp"

namespace hbvm::core {

template <Scalar S>
Trial<S>::Trial(const Claim& subject, SolverKind solver)
    : digits_(static_cast<unsigned>(digits10<S>())), assembled_(assemble<S>(load_scene(subject.problem))) {
  make_stepper_ = subject.method->prepare(assembled_.problem, solver);
  if (const HbvmMethod* const hbvm = as_hbvm(*subject.method))
    coefficients_of_lambda_ = hbvm->constraint_nodes(assembled_.problem) > hbvm->name().s;
}

template <Scalar S>
void Trial<S>::begin(const Laboratory::Start& start, const Mpfr& h) {
  const PrecisionScope working(digits_);
  h_ = rounded_to<S>(raw(h));
  state_.emplace(rounded<S>(start.q), rounded<S>(start.p));
  stepper_ = make_stepper_();
  last_ = {};
}

template <Scalar S>
long Trial<S>::step() {
  const PrecisionScope working(digits_);
  last_ = stepper_->step(*state_, h_);
  return last_.sweeps;
}

template <Scalar S>
void Trial<S>::reverse() {
  const PrecisionScope working(digits_);
  if (!assembled_.problem.is_conservative()) {
    set_negative(h_, h_);
    return;
  }
  for (Index j = 0; j < state_->p.size(); ++j) {
    set_negative(state_->p[j], state_->p[j]);
    set_negative(state_->p_carry[j], state_->p_carry[j]);
  }
}

template <Scalar S>
void Trial<S>::state(Vector<Mpfr>& q, Vector<Mpfr>& p) const {
  copy_exactly(q, state_->q);
  copy_exactly(p, state_->p);
}

template <Scalar S>
void Trial<S>::between(const Mpfr& after, Vector<Mpfr>& q, Vector<Mpfr>& p, Vector<Mpfr>& lambda) const {
  StateBetween<S> found;
  {
    const PrecisionScope working(digits_);
    BetweenSteps<S> steps(make_stepper_());
    Snapshot<S> mesh;
    mesh.t = 0;
    mesh.q = state_->q;
    mesh.p = state_->p;
    found = steps.at(mesh, rounded_to<S>(raw(after)));
  }
  copy_exactly(q, found.q);
  copy_exactly(p, found.p);
  copy_exactly(lambda, found.lambda);
}

template <Scalar S>
void Trial<S>::multiplier(Vector<Mpfr>& lambda) const {
  copy_exactly(lambda, *last_.multiplier);
}

template <Scalar S>
void Trial<S>::unknowns(Matrix<Mpfr>* gamma, Matrix<Mpfr>* lambda) {
  const StageUnknowns<S>& x = *last_.unknowns;
  if (gamma) copy_exactly(*gamma, x.gamma);
  if (!lambda) return;
  copy_exactly(*lambda, x.lambda);
  if (!coefficients_of_lambda_) return;
  const auto s = static_cast<int>(lambda->rows());
  const Matrix<Mpfr> P = legendre_values<Mpfr>(gauss_legendre<Mpfr>(s).c, s);
  *lambda = P.lazyProduct(Matrix<Mpfr>(*lambda));
}

template <Scalar S>
StepPolynomials polynomials(Trial<S>& trial, const Vector<Mpfr>& q0, const Vector<Mpfr>& p1, const Mpfr& h, Index s) {
  StepPolynomials result{h, q0, p1, Matrix<Mpfr>(s, q0.size())};
  trial.unknowns(&result.gamma, nullptr);
  return result;
}

template <Scalar S>
Mpfr delta_lambda(Laboratory& laboratory, Trial<S>& trial, const Vector<Mpfr>& q0, const Vector<Mpfr>& p1,
                  const Mpfr& h, Index s) {
  const StepPolynomials step = polynomials(trial, q0, p1, h, s);
  Matrix<Mpfr> lambda(s, laboratory.problem().nu());
  trial.unknowns(nullptr, &lambda);
  const Quadrature<Mpfr> gauss = gauss_legendre<Mpfr>(static_cast<int>(s));
  Vector<Mpfr> u = q0, v = p1;
  Mpfr greatest = 0;
  for (Index i = 0; i < s; ++i) {
    step.at(laboratory.problem(), gauss.c[i], u, v);
    const Vector<Mpfr>& there = laboratory.point().multiplier(u, v);
    for (Index a = 0; a < there.size(); ++a) raise_to(greatest, Mpfr(abs(Mpfr(there[a] - lambda(i, a)))));
  }
  return greatest;
}

#define HBVM_DEFINE(S)                                                                                              \
  template class Trial<S>;                                                                                          \
  template StepPolynomials polynomials<S>(Trial<S>&, const Vector<Mpfr>&, const Vector<Mpfr>&, const Mpfr&, Index); \
  template Mpfr delta_lambda<S>(Laboratory&, Trial<S>&, const Vector<Mpfr>&, const Vector<Mpfr>&, const Mpfr&, Index);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

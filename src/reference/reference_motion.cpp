#include "reference/reference_motion.hpp"

#include <cmath>
#include <limits>

#include "basis/legendre.hpp"
#include "problem/driven_course.hpp"
#include "step/hbvm_stepper.hpp"

namespace hbvm::core {

void StepPolynomials::at(const Problem<Mpfr>& problem, const Mpfr& tau, Vector<Mpfr>& u, Vector<Mpfr>& v) const {
  const int s = static_cast<int>(gamma.rows());
  const Vector<Mpfr> here = Vector<Mpfr>::Constant(1, tau), end = Vector<Mpfr>::Constant(1, Mpfr(1));
  const Matrix<Mpfr> P = legendre_values<Mpfr>(here, s + 1), I = legendre_integrals<Mpfr>(here, s),
                     P_end = legendre_values<Mpfr>(end, s + 1);
  Vector<Mpfr> sum(q0.size());
  for (Index j = 0; j < q0.size(); ++j) {
    Mpfr last = p1[j];
    v[j] = 0;
    sum[j] = 0;
    for (int i = 0; i < s; ++i) {
      last -= P_end(0, i) * gamma(i, j);
      v[j] += P(0, i) * gamma(i, j);
      sum[j] += I(0, i) * gamma(i, j);
    }
    v[j] += P(0, s) * last / P_end(0, s);
  }
  problem.mass.velocity(lanes(std::as_const(sum)), lanes(u));
  for (Index j = 0; j < q0.size(); ++j) u[j] = q0[j] + h * u[j];
  if (problem.driven.empty()) return;
  u[problem.clock()] += tau * h;
  DrivenCourse<Mpfr> course(problem, 1);
  place(course, problem, u);
  course.set_positions(lanes(u));
}

ReferenceMotion::ReferenceMotion(const Problem<Mpfr>& problem, const Vector<Mpfr>& q0, const Vector<Mpfr>& p0,
                                 const Mpfr& duration, long steps, int stages, std::function<void()> after_step)
    : problem_(problem),
      q0_(q0),
      p0_(p0),
      duration_(duration),
      steps_(steps),
      stages_(stages),
      after_step_(std::move(after_step)),
      point_(problem) {
  constexpr double unknown = std::numeric_limits<double>::infinity();
  errors_ = {unknown, unknown, unknown};
  run(SolverKind::newton);
  refine();
}

void ReferenceMotion::run(SolverKind solver) {
  const Hbvm<Mpfr> method = make_hbvm<Mpfr>(stages_, stages_);
  const Mpfr h = duration_ / steps_;
  HbvmStepper<Mpfr> stepper(problem_, method, solver);
  State<Mpfr> state(q0_, p0_);
  for (long n = 0; n < steps_; ++n) {
    if (n + 1 == steps_) polynomials_.q0 = state.q;
    stepper.step(state, h);
    if (after_step_) after_step_();
  }
  q_ = state.q;
  p_ = point_.tangential(state.q, state.p);
  lambda_ = point_.multiplier(q_, p_);
  polynomials_.h = h;
  polynomials_.p1 = state.p;
  polynomials_.gamma = stepper.solver().unknowns().gamma;
}

double ReferenceMotion::q_unit() const {
  return log2_of(std::max(max_norm(q0_), max_norm(q_))) - static_cast<double>(mpfr_working_bits());
}

double ReferenceMotion::p_unit() const {
  return log2_of(std::max(max_norm(p0_), max_norm(p_))) - static_cast<double>(mpfr_working_bits());
}

bool ReferenceMotion::is_exact() const {
  constexpr int units = 10;
  return errors_.q <= q_unit() + units && errors_.p <= p_unit() + units;
}

bool ReferenceMotion::refine() {
  if (is_exact()) return false;
  const Vector<Mpfr> q = q_, p = p_, lambda = lambda_;
  stages_ += 2;
  run(SolverKind::fixed_point);
  const Errors before = errors_;
  const double lambda_unit = log2_of(max_norm(lambda_)) - static_cast<double>(mpfr_working_bits());
  errors_ = {std::max(log2_of(distance(q_, q)), q_unit()), std::max(log2_of(distance(p_, p)), p_unit()),
             std::max(log2_of(distance(lambda_, lambda)), lambda_unit)};
  return std::max(errors_.q - q_unit(), errors_.p - p_unit()) < std::max(before.q - q_unit(), before.p - p_unit());
}

}  // namespace hbvm::core

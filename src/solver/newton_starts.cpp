#include "solver/newton_starts.hpp"

#include "linear/arrays.hpp"
#include "scalar/binary_exponent.hpp"
#include "scalar/in_place.hpp"

namespace hbvm::core {
namespace {

/// The index of the body that each coordinate belongs to; driven ones are one more.
template <Scalar S>
std::vector<Index> bodies_of(const Problem<S>& problem) {
  std::vector<Index> bodies;
  Index body = 0;
  for (const auto& block : problem.mass.blocks())
    bodies.insert(bodies.end(), static_cast<std::size_t>(block.size), body++);
  bodies.resize(static_cast<std::size_t>(problem.m()), body);
  return bodies;
}

}  // namespace

template <Scalar S>
NewtonStarts<S>::NewtonStarts(const Problem<S>& problem, const Hbvm<S>& method, const StageUnknowns<S>& like)
    : problem_(problem),
      extrapolation_(method.s, problem.m() + problem.nu()),
      continuation_(method, bodies_of(problem), problem.nu()),
      sequence_(like.gamma.size() + like.lambda.size()) {
  count_.per_call = extrapolation_.operations();
}

template <Scalar S>
void NewtonStarts<S>::clear() {
  extrapolation_.clear();
  continuation_.clear();
}

template <Scalar S>
bool NewtonStarts<S>::continuation_is_nearer() const {
  // Errors of the momenta of some body, over their size.
  long continued = exponent_of_zero, extrapolated = exponent_of_zero;
  for (const auto& block : problem_.mass.blocks()) {
    long size = exponent_of_zero, a = exponent_of_zero, b = exponent_of_zero;
    for (Index j = block.offset; j < block.offset + block.size; ++j) {
      size = std::max(size, continuation_.size_exponent(j));
      a = std::max(a, continuation_.error_exponent(j));
      b = std::max(b, extrapolation_.error_exponent(j));
    }
    if (size == exponent_of_zero) continue;
    continued = std::max(continued, a - size);
    extrapolated = std::max(extrapolated, b - size);
  }
  return continued < extrapolated;
}

template <Scalar S>
void NewtonStarts<S>::predict(StageUnknowns<S>& x) {
  if (continuation_is_nearer()) return continuation_.predict(x);
  extrapolation_.predict(sequence_.data());
  for (Index i = 0; i < x.gamma.size(); ++i) set(x.gamma.data()[i], sequence_[i]);
  for (Index i = 0; i < x.lambda.size(); ++i) set(x.lambda.data()[i], sequence_[x.gamma.size() + i]);
}

template <Scalar S>
void NewtonStarts<S>::set_constant(StageEquations<S>& equations, StageUnknowns<S>& x) {
  const Vector<S>& p0 = equations.p0();
  set_zero(x.gamma);
  set_zero(x.lambda);
  for (Index j = 0; j < p0.size(); ++j) set(x.gamma(0, j), p0[j]);
  // Those that a sweep of the fixed-point iteration from there would have.
  equations.move(x.gamma);
  equations.forces(x.psi);
  if (!equations.multipliers(x.psi, x.lambda, x.zeta)) set_zero(x.lambda);
}

template <Scalar S>
void NewtonStarts<S>::keep(const StageUnknowns<S>& solution) {
  const PartCall counted(count_);
  set(sequence_, solution.gamma);
  for (Index i = 0; i < solution.lambda.size(); ++i)
    set(sequence_[solution.gamma.size() + i], solution.lambda.data()[i]);
  extrapolation_.add(sequence_.data());
  continuation_.keep(solution);
}

#define HBVM_DEFINE(S) template class NewtonStarts<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

#include "integrate/constraint_moment.hpp"

#include "problem/redundant_constraints.hpp"
#include "scene/turning.hpp"

namespace hbvm::core {
namespace {

template <Scalar S>
Problem<S> with_all_constraints(Problem<S> problem) {
  problem.constraints = all_constraints(problem);
  problem.redundant.clear();
  return problem;
}

}  // namespace

template <Scalar S>
ConstraintMoment<S>::ConstraintMoment(const Problem<S>& problem)
    : problem_(with_all_constraints(problem)), gradient_(problem_, 1), turned_(Vector<S>::Zero(problem.m())) {}

template <Scalar S>
S ConstraintMoment<S>::operator()(const SeenState<S>& state, const std::vector<Index>& constraints,
                                  const std::vector<Index>& directors, const Vector<S>& w) {
  const Index d = problem_.dimension;
  for (Index j = 0; j < turned_.size(); ++j) set_zero(turned_[j]);
  for (const Index at : directors) turned_.segment(at, d) = turned(w, Vector<S>(state.q.segment(at, d)));
  gradient_.update(lanes(state.q));
  S sum = 0, rate = 0;
  for (const Index a : constraints) {
    gradient_.transposed_times(a, lanes(std::as_const(turned_)), &rate);
    sum -= state.lambda[a] * rate;
  }
  return sum;
}

#define HBVM_DEFINE(S) template class ConstraintMoment<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

#include "problem/general_drift.hpp"

namespace hbvm::core {

template <Scalar S>
GeneralDrift<S>::GeneralDrift(const Problem<S>& problem) : problem_(problem), epsilon_(epsilon<S>()) {
  for (const Constraint<S>& constraint : problem.constraints)
    if (degree(constraint) != 2) constraints_.push_back(&constraint);
  start_ = size_ = Vector<S>::Zero(static_cast<Index>(constraints_.size()));
}

template <Scalar S>
void GeneralDrift<S>::start(const Vector<S>& q) {
  for (Index a = 0; a < start_.size(); ++a) {
    const ConstraintValue<S> there = value(*constraints_[static_cast<std::size_t>(a)], problem_.dimension, q);
    start_[a] = there.g;
    size_[a] = there.size;
  }
}

template <Scalar S>
const S& GeneralDrift<S>::in_units(const Vector<S>& q) {
  units_ = 0;
  for (Index a = 0; a < start_.size(); ++a) {
    const ConstraintValue<S> here = value(*constraints_[static_cast<std::size_t>(a)], problem_.dimension, q);
    const S change = magnitude(S(here.g - start_[a]));
    if (here.size > size_[a]) size_[a] = here.size;
    if (!(change <= 0)) raise_to(units_, S(change / (2 * epsilon_ * size_[a])));
  }
  return units_;
}

#define HBVM_DEFINE(S) template class GeneralDrift<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

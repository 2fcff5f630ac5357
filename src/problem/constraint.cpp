#include "hbvm/problem/constraint.hpp"

namespace hbvm {

template <Scalar S>
std::vector<Index> coordinates(const Constraint<S>& constraint, Index dimension) {
  const auto found = std::visit([&](const auto& form) { return form.coordinates(dimension); }, constraint.form);
  return {found.begin(), found.end()};
}

template <Scalar S>
ConstraintValue<S> value(const Constraint<S>& constraint, Index dimension, const Vector<S>& q) {
  return std::visit([&](const auto& form) { return form.value(dimension, q); }, constraint.form);
}

template <Scalar S>
S gradient_size(const Constraint<S>& constraint, Index dimension, const Vector<S>& q) {
  return std::visit([&](const auto& form) { return form.gradient_size(dimension, max_norm(q)); }, constraint.form);
}

template <Scalar S>
S curvature(const Constraint<S>& constraint, Index dimension, const Vector<S>& v) {
  return std::visit([&](const auto& form) { return form.curvature(dimension, v); }, constraint.form);
}

template <Scalar S>
S curvature_size(const Constraint<S>& constraint, Index dimension, const Vector<S>& v) {
  // The same of what has no negative entries.
  return std::visit([&](const auto& form) { return form.positive().curvature(dimension, magnitudes(v)); },
                    constraint.form);
}

template <Scalar S>
Constraint<double> in_double(const Constraint<S>& constraint) {
  return {constraint.name,
          std::visit([](const auto& form) -> ConstraintForms<double> { return form.in_double(); }, constraint.form)};
}

#define HBVM_DEFINE(S)                                                                 \
  template std::vector<Index> coordinates<S>(const Constraint<S>&, Index);             \
  template ConstraintValue<S> value<S>(const Constraint<S>&, Index, const Vector<S>&); \
  template S gradient_size<S>(const Constraint<S>&, Index, const Vector<S>&);          \
  template S curvature<S>(const Constraint<S>&, Index, const Vector<S>&);              \
  template S curvature_size<S>(const Constraint<S>&, Index, const Vector<S>&);         \
  template Constraint<double> in_double<S>(const Constraint<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm

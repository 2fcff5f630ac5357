#include "problem/constraint.hpp"

#include <algorithm>

#include "problem/effect/trace.hpp"

namespace hbvm::core {

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
  return std::visit(
      [&]<class Form>(const Form& form) {
        if constexpr (ConstraintForm<Form, S>)
          return form.gradient_size(dimension, max_norm(q));
        else
          return form.gradient_size(dimension, q);
      },
      constraint.form);
}

template <Scalar S>
int degree(const Constraint<S>& constraint) {
  const auto* const formula = std::get_if<FormulaConstraint<S>>(&constraint.form);
  return formula ? formula->degree() : 2;
}

template <Scalar S>
int degree(const std::vector<Constraint<S>>& constraints) {
  int greatest = 2;
  for (const Constraint<S>& constraint : constraints) {
    const int own = degree(constraint);
    if (own == Trace<S>::not_polynomial) return own;
    greatest = std::max(greatest, own);
  }
  return greatest;
}

template <Scalar S>
std::map<Index, std::map<Index, S>> second_derivatives(const Constraint<S>& constraint, Index dimension) {
  std::map<Index, std::map<Index, S>> found;
  std::visit(
      [&]<class Form>(const Form& form) {
        if constexpr (ConstraintForm<Form, S>)
          form.second_derivatives(dimension, [&](Index i, Index j, const S& h) {
            const auto [entry, is_new] = found[i].emplace(j, h);
            if (!is_new) entry->second += h;
          });
      },
      constraint.form);
  for (auto& [i, row] : found) std::erase_if(row, [](const auto& entry) { return entry.second == 0; });
  return found;
}

template <Scalar S>
S curvature(const Constraint<S>& constraint, Index dimension, const Vector<S>& q, const Vector<S>& v) {
  return std::visit(
      [&]<class Form>(const Form& form) {
        if constexpr (ConstraintForm<Form, S>)
          return form.curvature(dimension, v);
        else
          return form.curvature(dimension, q, v);
      },
      constraint.form);
}

template <Scalar S>
S curvature_size(const Constraint<S>& constraint, Index dimension, const Vector<S>& q, const Vector<S>& v) {
  return std::visit(
      [&]<class Form>(const Form& form) {
        // The same of what has no negative entries.
        if constexpr (ConstraintForm<Form, S>)
          return form.positive().curvature(dimension, magnitudes(v));
        else
          return form.curvature_size(dimension, q, v);
      },
      constraint.form);
}

template <Scalar S>
Constraint<double> in_double(const Constraint<S>& constraint) {
  return {constraint.name,
          std::visit([](const auto& form) -> ConstraintForms<double> { return form.in_double(); }, constraint.form)};
}

#define HBVM_DEFINE(S)                                                                             \
  template std::vector<Index> coordinates<S>(const Constraint<S>&, Index);                         \
  template ConstraintValue<S> value<S>(const Constraint<S>&, Index, const Vector<S>&);             \
  template S gradient_size<S>(const Constraint<S>&, Index, const Vector<S>&);                      \
  template int degree<S>(const Constraint<S>&);                                                    \
  template int degree<S>(const std::vector<Constraint<S>>&);                                       \
  template S curvature<S>(const Constraint<S>&, Index, const Vector<S>&, const Vector<S>&);        \
  template S curvature_size<S>(const Constraint<S>&, Index, const Vector<S>&, const Vector<S>&);   \
  template std::map<Index, std::map<Index, S>> second_derivatives<S>(const Constraint<S>&, Index); \
  template Constraint<double> in_double<S>(const Constraint<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

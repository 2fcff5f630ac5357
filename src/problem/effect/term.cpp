#include "problem/effect/term.hpp"

#include "linear/in_double.hpp"

namespace hbvm::core {
namespace {

template <Scalar S>
EffectSymmetry<double> rounded(const EffectSymmetry<S>& symmetry) {
  EffectSymmetry<double> result{symmetry.kind, symmetry.acts, in_double(symmetry.axes),
                                in_double(symmetry.axis_round_off), in_double(symmetry.conditions)};
  for (Index i = 0; i < result.axes.size(); ++i)
    result.axis_round_off.data()[i] += epsilon<double>() * magnitude(result.axes.data()[i]);
  return result;
}

}  // namespace

template <Scalar S>
EffectTerm<double> in_double(const EffectTerm<S>& term) {
  EffectTerm<double> result{term.kind,
                            term.degree,
                            in_double(term.value),
                            in_double(term.gradient),
                            in_double(term.hessian),
                            term.constant_force,
                            term.arguments,
                            {},
                            in_double(term.value_coefficients),
                            in_double(term.gradient_coefficients),
                            in_double(term.hessian_coefficients),
                            rounded(term.symmetry)};
  for (const auto& x : term.displacements) result.displacements.push_back(in_double(x));
  return result;
}

#define HBVM_DEFINE(S) template EffectTerm<double> in_double<S>(const EffectTerm<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

#include "hbvm/problem/in_double.hpp"

#include <cstdlib>

#include "hbvm/scalar/binary_exponent.hpp"

namespace hbvm {
namespace {

template <Scalar S>
Program<double> rounded(const Program<S>& program) {
  std::vector<double> constants;
  for (const S& value : program.constants()) constants.push_back(approximately(value));
  return {std::move(constants), program.instructions(), program.output_operands(), program.temporaries()};
}

template <Scalar S>
EffectSymmetry<double> rounded(const EffectSymmetry<S>& symmetry) {
  EffectSymmetry<double> result{symmetry.kind, symmetry.acts, in_double(symmetry.axes),
                                in_double(symmetry.axis_round_off), in_double(symmetry.conditions)};
  for (Index i = 0; i < result.axes.size(); ++i)
    result.axis_round_off.data()[i] += epsilon<double>() * magnitude(result.axes.data()[i]);
  return result;
}

template <Scalar S>
EffectTerm<double> rounded(const EffectTerm<S>& term) {
  EffectTerm<double> result{term.kind,
                            term.degree,
                            rounded(term.value),
                            rounded(term.gradient),
                            rounded(term.hessian),
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

}  // namespace

template <Scalar S>
Problem<double> in_double(const Problem<S>& problem) {
  Problem<double> result;
  result.dimension = problem.dimension;
  result.blocks = problem.blocks;
  for (const auto& block : problem.mass.blocks()) {
    if (block.full)
      result.mass.add_full(in_double(block.M));
    else
      result.mass.add_scalar(block.size, approximately(block.mass));
  }
  for (const auto& constraint : problem.constraints) result.constraints.push_back(in_double(constraint));
  result.potential.dimension = problem.potential.dimension;
  result.potential.m = problem.potential.m;
  for (const auto& term : problem.potential.terms) result.potential.terms.push_back(rounded(term));
  for (const auto& constraint : problem.general)
    result.general.push_back({constraint.place, constraint.name, rounded(constraint.g)});
  return result;
}

template <Scalar S>
bool fits_double(const S& x) {
  constexpr long range = 500;
  return x == 0 || std::abs(binary_exponent(x)) < range;
}

template <Scalar S>
bool fits_double(const Problem<S>& problem) {
  bool all = true;
  for (const auto& block : problem.mass.blocks()) {
    if (!block.full) all = all && fits_double(block.mass);
    for (Index i = 0; i < block.M.size(); ++i) all = all && fits_double(block.M.data()[i]);
  }
  return all;
}

#define HBVM_DEFINE(S)                                      \
  template Problem<double> in_double<S>(const Problem<S>&); \
  template bool fits_double<S>(const S&);                   \
  template bool fits_double<S>(const Problem<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm

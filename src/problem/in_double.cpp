#include "problem/in_double.hpp"

#include <cstdlib>

#include "scalar/binary_exponent.hpp"

namespace hbvm::core {
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
  for (const auto& point : problem.driven) result.add(in_double(point));
  for (const auto& force : problem.forces) result.forces.push_back(in_double(force));
  for (const auto& constraint : problem.constraints) result.constraints.push_back(in_double(constraint));
  result.potential.dimension = problem.potential.dimension;
  result.potential.m = problem.potential.m;
  for (const auto& term : problem.potential.terms) result.potential.terms.push_back(in_double(term));
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

}  // namespace hbvm::core

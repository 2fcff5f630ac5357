#include "solver/branch_guard.hpp"

#include "scalar/in_place.hpp"

namespace hbvm::core {

template <Scalar S>
BranchGuard<S>::BranchGuard(const Problem<S>& problem, const Hbvm<S>& method)
    : problem_(problem), method_(method), size_(problem.m()) {}

template <Scalar S>
void BranchGuard<S>::start(const StageEquations<S>& equations, const StageUnknowns<S>& start) {
  equations_ = &equations;
  start_ = &start;
  const S& h = equations.step();
  for (const auto& block : problem_.mass.blocks()) {
    S size = 0;
    for (Index j = block.offset; j < block.offset + block.size; ++j) {
      raise_magnitude(size, equations.p0()[j]);
      for (Index i = 0; i < start.psi.rows(); ++i) {
        raise_magnitude(size, S(h * start.psi(i, j)));
        raise_magnitude(size, S(h * start.zeta(i, j)));
      }
    }
    for (Index j = block.offset; j < block.offset + block.size; ++j) set(size_[j], size);
  }
}

template <Scalar S>
bool BranchGuard<S>::is_far(const StageUnknowns<S>& x) const {
  // Body by body: a coordinate may be small for a moment.
  for (const auto& block : problem_.mass.blocks()) {
    S moved = 0, forces_changed = 0;
    for (Index j = block.offset; j < block.offset + block.size; ++j)
      for (Index i = 0; i < start_->gamma.rows(); ++i) {
        raise_magnitude(moved, S(x.gamma(i, j) - start_->gamma(i, j)));
        raise_magnitude(forces_changed, S(equations_->step() * (x.psi(i, j) - start_->psi(i, j))));
      }
    const S& size = size_[block.offset];
    if (moved > size || 2 * forces_changed > size) return true;
  }
  return false;
}

template <Scalar S>
bool BranchGuard<S>::multipliers_run_wild(const StageUnknowns<S>& x) const {
  constexpr int much = 4;
  const ConstraintGradient<S>& gradient = equations_->constraint_gradient();
  const auto change_at_node = [&](Index i, Index a) {
    if (!method_.has_coefficients_of_lambda()) return S(x.lambda(i, a) - start_->lambda(i, a));
    S sum = 0;
    for (Index l = 0; l < method_.s; ++l) sum += method_.P_s(i, l) * (x.lambda(l, a) - start_->lambda(l, a));
    return sum;
  };
  for (Index a = 0; a < x.lambda.cols(); ++a) {
    const auto& pattern = gradient.pattern(a);
    for (std::size_t c = 0; c < pattern.coordinates.size(); ++c) {
      if (pattern.coordinates[c] >= problem_.mass.of_bodies()) continue;
      const Index column = pattern.first + static_cast<Index>(c);
      const S most = much * size_[pattern.coordinates[c]];
      for (Index i = 0; i < method_.r; ++i)
        if (!(magnitude(S(equations_->step() * gradient.values()(i, column) * change_at_node(i, a))) <= most))
          return true;
    }
  }
  return false;
}

#define HBVM_DEFINE(S) template class BranchGuard<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

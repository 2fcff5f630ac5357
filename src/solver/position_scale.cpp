#include "solver/position_scale.hpp"

#include "linear/arrays.hpp"

namespace hbvm::core {

template <Scalar S>
PositionScale<S>::PositionScale(const Problem<S>& problem)
    : problem_(problem),
      turns_(static_cast<std::size_t>(problem.m()), false),
      of_space_(Vector<S>::Zero(problem.m())),
      of_turns_(of_space_) {
  for (const SpaceBlock& block : problem.blocks)
    for (Index i = 0; i < problem.dimension && !block.translates; ++i)
      turns_[static_cast<std::size_t>(block.offset + i)] = true;
}

template <Scalar S>
void PositionScale<S>::take_step(const S& h) {
  set(h_, h);
  set_zero(of_space_);
  set_zero(of_turns_);
  const S inverse_step = magnitude(S(1 / h));
  for (const auto& block : problem_.mass.blocks())
    for (Index i = 0; i < block.size; ++i)
      for (Index l = 0; l < block.size; ++l) {
        if (!block.full && l != i) continue;
        const Index row = block.offset + i, column = block.offset + l;
        const S mass = block.full ? magnitude(block.M(i, l)) : block.mass;
        (turns_[static_cast<std::size_t>(column)] ? of_turns_ : of_space_)[row] += mass * inverse_step;
      }
}

template <Scalar S>
void PositionScale<S>::evaluate(const Vector<S>& q, const S& h, Vector<S>& scale) {
  if (h != h_) take_step(h);
  set_zero(space_);
  set_zero(directors_);
  for (Index j = 0; j < q.size(); ++j) raise_magnitude(turns_[static_cast<std::size_t>(j)] ? directors_ : space_, q[j]);
  for (Index j = 0; j < q.size(); ++j) {
    set_product(scale[j], of_space_[j], space_);
    add_product(scale[j], of_turns_[j], directors_, t_);
  }
}

#define HBVM_DEFINE(S) template class PositionScale<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

#include "solver/body_scale.hpp"

#include "linear/arrays.hpp"
#include "scalar/in_place.hpp"

namespace hbvm::core {

template <Scalar S>
BodyScale<S>::BodyScale(const Problem<S>& problem) : problem_(problem), scale_(problem.m()) {}

template <Scalar S>
void BodyScale<S>::keep(const StoppingRule<S>& rule) {
  for (const auto& block : problem_.mass.blocks()) {
    set_zero(scale_now_);
    for (Index j = block.offset; j < block.offset + block.size; ++j) raise_magnitude(scale_now_, rule.scale(j));
    for (Index j = block.offset; j < block.offset + block.size; ++j) set(scale_[j], scale_now_);
  }
}

template <Scalar S>
void BodyScale<S>::measure(const Matrix<S>& change, const StoppingRule<S>& rule, S& size) {
  set_zero(size);
  for (Index j = 0; j < scale_.size(); ++j) {
    set_zero(greatest_);
    for (Index i = 0; i < change.rows(); ++i) raise_magnitude(greatest_, change(i, j));
    if (greatest_ == 0) continue;
    set_quotient(greatest_, greatest_, scale_[j] == 0 ? rule.scale(j) : scale_[j]);
    raise_magnitude(size, greatest_);
  }
}

template <Scalar S>
bool BodyScale<S>::leaves_little(const Matrix<S>& residual, const StoppingRule<S>& rule) {
  for (const auto& block : problem_.mass.blocks()) {
    set_zero(greatest_);
    set_zero(scale_now_);
    for (Index j = block.offset; j < block.offset + block.size; ++j) {
      raise_magnitude(scale_now_, rule.scale(j));
      for (Index i = 0; i < residual.rows(); ++i) raise_magnitude(greatest_, residual(i, j));
    }
    if (16 * greatest_ > scale_now_) return false;
  }
  return true;
}

#define HBVM_DEFINE(S) template class BodyScale<S>;
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

#pragma once

#include "problem/state_evaluator.hpp"

namespace hbvm::core {

/// What one reports beside the propagated state (q, p). It is p projected once, on a copy, to the tangent space, and
/// the multiplier of Theorem 1 there. Both, like q, converge with order 2s, where raw p and the multiplier (57) show s
/// or s + 1 and one less. Its own energy differs from H_0 by O(h^(2r)). This is the superconvergence of projected
/// collocation for index-2 systems (Ascher and Petzold 1991; Chan, Chartier and Murua).
template <Scalar S>
struct OutputState {
  Vector<S> p, lambda;
};

template <Scalar S>
OutputState<S> output_state(StateEvaluator<S>& point, const Vector<S>& q, const Vector<S>& p) {
  OutputState<S> output;
  output.p = point.tangential(q, p);
  output.lambda = point.multiplier(q, output.p);
  return output;
}

}  // namespace hbvm::core

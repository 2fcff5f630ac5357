#pragma once

#include "problem/effect/program.hpp"

namespace hbvm::core {

/// A program of the gradient of an effect, as one of several that act on the same displacements.
template <Scalar S>
struct JointPart {
  const Program<S>* program;
  std::size_t coefficients;  ///< its inputs behind the displacement's
};

/// Several programs as one that computes once what they have in common: a distance and its reciprocal, say. Every
/// number is what it is in the programs one by one, to the last bit.
template <Scalar S>
struct JointProgram {
  /// Inputs are the displacement, then the coefficients of one program after another; so are the outputs.
  Program<S> program;
  /// How many instructions make the outputs of each, those before included: the rest is what the next one adds.
  std::vector<std::size_t> ends;
};

/// \param inputs components of the displacement
template <Scalar S>
JointProgram<S> join(const std::vector<JointPart<S>>& parts, std::size_t inputs);

}  // namespace hbvm::core

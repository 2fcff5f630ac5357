#pragma once

#include "problem/effect/registry.hpp"
#include "problem/effect/term.hpp"
#include "problem/effect/trace.hpp"

namespace hbvm::core {

/// The numbers of one use of an effect. They are its keys, and for each body or pair its parameters. These come in the
/// order mass matrix (on_each_body only), masses (two for pairs, else one), charges (two, or one and the centre's).
template <Scalar S>
struct EffectInput {
  std::string kind;
  Index dimension = 0;
  std::map<std::string, S, std::less<>> numbers;
  std::map<std::string, std::vector<S>, std::less<>> vectors;
  struct Instance {
    Displacement<S> x;
    Matrix<S> mass_matrix;  ///< d x d
    S masses[2] = {S(0), S(0)};
    S charges[2] = {S(0), S(0)};
  };
  std::vector<Instance> instances;
};

/// Evaluates the effect's formula once on Traced values and compiles U and dU/dx.
template <Scalar S>
EffectTerm<S> make_term(const EffectInput<S>& input);

}  // namespace hbvm::core

#pragma once

#include "printing.hpp"
#include "problem/momenta.hpp"
#include "problem/state_evaluator.hpp"
#include "scene/assemble.hpp"
#include "scene/scene_text.hpp"

namespace hbvm::core {

template <Scalar S>
Assembled<S> assembled(const std::string& text, Consistency consistency = Consistency::checked) {
  return assemble<S>(read_scene(text, "test.toml"), consistency);
}

/// What assemble refuses the text with; empty if it does not.
template <Scalar S>
std::string inconsistency(const std::string& text) {
  return refused([&] { assembled<S>(text); });
}

/// The conserved momenta: "P_x, L_z".
template <Scalar S>
std::string conserved(const Problem<S>& problem) {
  std::string names;
  for (const auto& component : conserved_momenta(problem)) names += (names.empty() ? "" : ", ") + component.name();
  return names;
}

/// A state that is on no symmetry of a scene.
template <Scalar S>
Vector<S> generic(Index size, int seed, int divisor = 7) {
  Vector<S> v(size);
  for (Index i = 0; i < size; ++i) v[i] = S(static_cast<int>((i * i * 7 + i * 5 + seed * 11) % 23) - 11) / divisor;
  return v;
}

/// The same a little way from a start.
template <Scalar S>
Vector<S> away_from(const Vector<S>& start, int divisor = 700) {
  return start + generic<S>(start.size(), 0, divisor);
}

/// That the forces at q are the derivatives of the energy.
inline void expect_forces_are_derivatives(const Problem<Mpfr>& problem, const Vector<Mpfr>& q) {
  StateEvaluator<Mpfr> at(problem);
  const Vector<Mpfr> zero = Vector<Mpfr>::Zero(q.size()), v = generic<Mpfr>(q.size(), 2);
  const Mpfr step = literal<Mpfr>("1e-16");
  const Mpfr slope =
      (at.energy(Vector<Mpfr>(q - step * v), zero) - at.energy(Vector<Mpfr>(q + step * v), zero)) / (2 * step);
  EXPECT_LE(magnitude(Mpfr(at.forces(q, zero).applied.dot(v) - slope)), literal<Mpfr>("1e-26"));
}

}  // namespace hbvm::core

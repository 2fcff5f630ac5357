#pragma once

#include <algorithm>
#include <vector>

#include "problem/problem.hpp"
#include "scalar/archive.hpp"
#include "solver/part_count.hpp"

namespace hbvm::core {

/// By effect, those of the potential before the forces without one, and by part of the stage equations, in whatever
/// precision they were evaluated.
struct SolverCounts {
  std::vector<EffectCount> effects;
  std::vector<PartCount> parts;

  void remember(Archive& archive) {
    archive.sized(effects);
    archive.sized(parts);
  }
};

/// sum += other; a constant force counts once, whatever the number of solvers.
template <Scalar S>
void add_counts(SolverCounts& sum, const SolverCounts& other, const Problem<S>& problem) {
  if (other.parts.empty()) return;
  if (sum.parts.empty()) {
    sum = other;
    return;
  }
  for (std::size_t t = 0; t < sum.effects.size(); ++t) {
    if (t < problem.potential.terms.size() && problem.potential.terms[t].constant_force) continue;
    sum.effects[t].calls += other.effects[t].calls;
    sum.effects[t].evaluations += other.effects[t].evaluations;
    sum.effects[t].seconds += other.effects[t].seconds;
  }
  for (const PartCount& part : other.parts) {
    const auto known = std::find_if(sum.parts.begin(), sum.parts.end(),
                                    [&](const PartCount& candidate) { return candidate.is_like(part); });
    if (known == sum.parts.end()) {
      sum.parts.push_back(part);
      continue;
    }
    known->calls += part.calls;
    known->seconds += part.seconds;
  }
}

/// The same as a new value.
template <Scalar S>
SolverCounts sum_of(SolverCounts counts, const SolverCounts& other, const Problem<S>& problem) {
  add_counts(counts, other, problem);
  return counts;
}

}  // namespace hbvm::core

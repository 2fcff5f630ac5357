#include "hbvm/problem/momenta.hpp"

#include <algorithm>

#include "hbvm/problem/constraint_gradient.hpp"

namespace hbvm {
namespace {

/// How the symmetry moves coordinates q: the axis itself for what translates, axis x q_block for a rotation.
template <Scalar S>
Vector<S> generator(const Problem<S>& problem, const MomentumComponent& component, const Vector<S>& q) {
  Vector<S> xi = Vector<S>::Zero(problem.m());
  const Index d = problem.dimension;
  for (const SpaceBlock& block : problem.blocks) {
    if (!component.angular) {
      if (block.translates) xi[block.offset + component.axis] = 1;
      continue;
    }
    const Index i = d == 2 ? 0 : (component.axis + 1) % 3, j = d == 2 ? 1 : (component.axis + 2) % 3;
    xi[block.offset + i] = -q[block.offset + j];
    xi[block.offset + j] = q[block.offset + i];
  }
  return xi;
}

/// Steps through a fixed sequence of numbers in (-1/2, 1/2) with no pattern a scene could share.
template <Scalar S>
class Sequence {
 public:
  S next() {
    state_ = (state_ * 7919 + 4271) % 10007;
    return S(static_cast<int>(state_)) / 10007 - S(1) / 2;
  }

 private:
  long state_ = 1;
};

template <Scalar S>
struct Pairing {
  S sum = 0, size = 0;
};

template <Scalar S>
Pairing<S> pair(const Vector<S>& a, const Vector<S>& b) {
  Pairing<S> r;
  for (Index i = 0; i < a.size(); ++i) {
    r.sum += a[i] * b[i];
    r.size += magnitude(S(a[i] * b[i]));
  }
  return r;
}

}  // namespace

template <Scalar S>
S momentum(const Problem<S>& problem, const MomentumComponent& component, const Vector<S>& q, const Vector<S>& p) {
  return pair<S>(generator(problem, component, q), p).sum;
}

template <Scalar S>
std::vector<MomentumComponent> conserved_momenta(const Problem<S>& problem, const Vector<S>& q) {
  const Index m = problem.m(), d = problem.dimension;
  std::vector<MomentumComponent> candidates;
  const bool translates = std::any_of(problem.blocks.begin(), problem.blocks.end(),
                                      [](const SpaceBlock& block) { return block.translates; });
  for (int axis = 0; translates && axis < d; ++axis) candidates.push_back({false, axis});
  for (int axis = d == 2 ? 2 : 0; axis < 3; ++axis) candidates.push_back({true, axis});

  ConstraintGradient<S> gradient(problem, 1);
  PotentialEvaluator<S> potential(problem.potential, 1);
  Matrix<S> force(1, m);
  Sequence<S> sequence;
  // Displacements are differences, and forces may amplify their round-off.
  const S tolerance = S(static_cast<long>(100'000 * m)) * epsilon<S>();
  S scale = max_norm(q);
  if (scale == 0) scale = 1;
  for (int trial = 0; trial < 3; ++trial) {
    Vector<S> x = q, p(m);
    for (Index i = 0; i < m; ++i) {
      x[i] += scale * sequence.next() / 64;
      p[i] = sequence.next();
    }
    gradient.update(lanes(x));
    Vector<S> f = potential.constant_force();
    if (potential.has_varying_force()) {
      potential.varying_force(lanes(x), force);
      f += force.row(0).transpose();
    }
    Vector<S> v(m);
    problem.mass.velocity(lanes(p), lanes(v));
    std::erase_if(candidates, [&](const MomentumComponent& component) {
      const Vector<S> xi = generator(problem, component, x);
      const Pairing<S> work = pair(f, xi);
      if (magnitude(work.sum) > tolerance * (work.size + max_norm(f) * max_norm(xi))) return true;
      for (Index a = 0; a < problem.nu(); ++a) {
        S change;
        gradient.transposed_times(0, a, lanes(xi), change);
        Matrix<S> unit = Matrix<S>::Zero(1, problem.nu());
        unit(0, a) = 1;
        Vector<S> g = Vector<S>::Zero(m);
        gradient.add_times(unit, lanes(g));
        if (magnitude(change) > tolerance * max_norm(g) * max_norm(xi)) return true;
      }
      if (!component.angular) return false;
      const Pairing<S> kinetic = pair<S>(generator(problem, component, p), v);
      return magnitude(kinetic.sum) > tolerance * kinetic.size;
    });
  }
  return candidates;
}

#define HBVM_DEFINE(S)                                                                                     \
  template S momentum<S>(const Problem<S>&, const MomentumComponent&, const Vector<S>&, const Vector<S>&); \
  template std::vector<MomentumComponent> conserved_momenta<S>(const Problem<S>&, const Vector<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm

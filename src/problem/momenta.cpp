#include "hbvm/problem/momenta.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hbvm/problem/constraint_gradient.hpp"

namespace hbvm {
namespace {

/// How the symmetry moves coordinates q: linear + angular x q_block, without `linear` for what does not translate.
template <Scalar S>
Vector<S> generator(const Problem<S>& problem, const MomentumComponent<S>& component, const Vector<S>& q) {
  Vector<S> xi = Vector<S>::Zero(problem.m());
  const Vector<S>& w = component.angular;
  const bool plane = w.size() == 1;
  for (const SpaceBlock& block : problem.blocks) {
    for (Index i = 0; block.translates && i < component.linear.size(); ++i) xi[block.offset + i] = component.linear[i];
    for (Index axis = 0; axis < w.size(); ++axis) {
      if (w[axis] == 0) continue;
      const Index i = plane ? 0 : (axis + 1) % 3, j = plane ? 1 : (axis + 2) % 3;
      xi[block.offset + i] -= w[axis] * q[block.offset + j];
      xi[block.offset + j] += w[axis] * q[block.offset + i];
    }
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
MomentumValue<S> pair(const Vector<S>& a, const Vector<S>& b) {
  MomentumValue<S> r;
  for (Index i = 0; i < a.size(); ++i) {
    const S term = a[i] * b[i];
    r.value += term;
    r.size += magnitude(term);
  }
  return r;
}

/// The largest entry of rows first and below, and columns first and to the right.
template <Scalar S>
std::pair<Index, Index> largest_entry(const Matrix<S>& a, Index first) {
  std::pair<Index, Index> at(first, first);
  for (Index j = first; j < a.cols(); ++j)
    for (Index i = first; i < a.rows(); ++i)
      if (magnitude(a(i, j)) > magnitude(a(at.first, at.second))) at = {i, j};
  return at;
}

/// Subtracts multiples of row `pivot` from all others so that column `column` is 0 there.
template <Scalar S>
void clear_column(Matrix<S>& a, Index pivot, Index column) {
  for (Index i = 0; i < a.rows(); ++i) {
    if (i == pivot || a(i, column) == 0) continue;
    const S factor = a(i, column) / a(pivot, column);
    for (Index j = 0; j < a.cols(); ++j) a(i, j) -= factor * a(pivot, j);
    a(i, column) = 0;
  }
}

/// The rows of the result span the null space of a, by elimination with complete pivoting; entries of rows left over
/// count as 0 up to the tolerance.
template <Scalar S>
Matrix<S> null_space(Matrix<S> a, const S& tolerance) {
  std::vector<Index> place(static_cast<std::size_t>(a.cols()));  // of each column before the exchanges
  for (Index j = 0; j < a.cols(); ++j) place[static_cast<std::size_t>(j)] = j;
  Index rank = 0;
  for (; rank < std::min(a.rows(), a.cols()); ++rank) {
    const auto [i, j] = largest_entry(a, rank);
    if (!(magnitude(a(i, j)) > tolerance)) break;
    a.row(i).swap(a.row(rank));
    a.col(j).swap(a.col(rank));
    std::swap(place[static_cast<std::size_t>(j)], place[static_cast<std::size_t>(rank)]);
    clear_column(a, rank, rank);
  }
  Matrix<S> result = Matrix<S>::Zero(a.cols() - rank, a.cols());
  for (Index n = 0; n < result.rows(); ++n) {
    result(n, place[static_cast<std::size_t>(rank + n)]) = 1;
    for (Index i = 0; i < rank; ++i) result(n, place[static_cast<std::size_t>(i)]) = -a(i, rank + n) / a(i, i);
  }
  return result;
}

/// The fraction with a small denominator that x is but for round-off, or x.
template <Scalar S>
S near_fraction(const S& x, const S& tolerance) {
  using std::floor;
  for (int denominator = 1; denominator <= 20; ++denominator) {
    const S multiple = x * denominator, whole = floor(S(multiple + S(1) / 2));
    if (magnitude(S(multiple - whole)) <= tolerance) return whole / denominator;
  }
  return x;
}

/// The reduced echelon form; what is 0 up to the tolerance is 0.
template <Scalar S>
void reduce(Matrix<S>& a, const S& tolerance) {
  Index row = 0;
  for (Index column = 0; column < a.cols() && row < a.rows(); ++column) {
    Index pivot = row;
    for (Index i = row; i < a.rows(); ++i)
      if (magnitude(a(i, column)) > magnitude(a(pivot, column))) pivot = i;
    if (!(magnitude(a(pivot, column)) > tolerance)) continue;
    a.row(pivot).swap(a.row(row));
    const S lead = a(row, column);
    for (Index j = 0; j < a.cols(); ++j) a(row, j) = a(row, j) / lead;
    clear_column(a, row, column);
    ++row;
  }
  for (Index i = 0; i < a.size(); ++i)
    if (magnitude(a.data()[i]) <= tolerance) set_zero(a.data()[i]);
}

}  // namespace

template <Scalar S>
std::string MomentumComponent<S>::name() const {
  std::string text;
  const auto add = [&](const Vector<S>& coefficients, const char* what, Index first_axis) {
    for (Index i = 0; i < coefficients.size(); ++i) {
      const double c = approximately(coefficients[i]);
      if (c == 0) continue;
      text += text.empty() ? (c < 0 ? "-" : "") : (c < 0 ? " - " : " + ");
      if (c != 1 && c != -1) text += fmt::format("{:.6g} ", c < 0 ? -c : c);
      text += std::string(what) + "xyz"[first_axis + i];
    }
  };
  add(angular, "L_", angular.size() == 1 ? 2 : 0);
  add(linear, "P_", 0);
  return text;
}

template <Scalar S>
std::vector<MomentumComponent<S>> coordinate_momenta(const Problem<S>& problem) {
  const Index d = problem.dimension, rotations = d == 2 ? 1 : 3;
  const bool translates = std::any_of(problem.blocks.begin(), problem.blocks.end(),
                                      [](const SpaceBlock& block) { return block.translates; });
  std::vector<MomentumComponent<S>> components;
  const MomentumComponent<S> none{Vector<S>::Zero(rotations), Vector<S>::Zero(d)};
  for (Index i = 0; translates && i < d; ++i) {
    components.push_back(none);
    components.back().linear[i] = 1;
  }
  for (Index i = 0; i < rotations; ++i) {
    components.push_back(none);
    components.back().angular[i] = 1;
  }
  return components;
}

template <Scalar S>
MomentumValue<S> momentum(const Problem<S>& problem, const MomentumComponent<S>& component, const Vector<S>& q,
                          const Vector<S>& p) {
  return pair<S>(generator(problem, component, q), p);
}

namespace {

/// The size of positions, which that of rotations is to translations.
template <Scalar S>
S extent(const Vector<S>& q) {
  const S size = max_norm(q);
  return size == 0 ? S(1) : size;
}

/// One row for each condition: by how much each component's symmetry changes U, a constraint or the kinetic energy at
/// points near q, over the size of that change's terms. Rotations count per extent of q.
template <Scalar S>
Matrix<S> conditions(const Problem<S>& problem, const std::vector<MomentumComponent<S>>& components,
                     const Vector<S>& q) {
  constexpr int points = 8;  // more than components
  const Index m = problem.m(), nu = problem.nu(), columns = static_cast<Index>(components.size());
  Matrix<S> rows = Matrix<S>::Zero(points * (nu + 2), columns);
  ConstraintGradient<S> gradient(problem, 1);
  PotentialEvaluator<S> potential(problem.potential, 1);
  Matrix<S> force(1, m);
  Sequence<S> sequence;
  const S scale = extent(q);
  Index row = 0;
  for (int point = 0; point < points; ++point) {
    Vector<S> x = q, p(m), v(m);
    for (Index i = 0; i < m; ++i) {
      x[i] += scale * sequence.next() / 64;
      p[i] = sequence.next();
    }
    problem.mass.velocity(lanes(p), lanes(v));
    gradient.update(lanes(x));
    Vector<S> f = potential.constant_force();
    if (potential.has_varying_force()) {
      potential.varying_force(lanes(x), force);
      f += force.row(0).transpose();
    }
    const auto condition = [&](const Vector<S>& slope) {
      const S size = max_norm(slope);
      for (Index j = 0; j < columns && size > 0; ++j) {
        const MomentumComponent<S>& component = components[static_cast<std::size_t>(j)];
        const S change = pair(slope, generator(problem, component, x)).value / size;
        rows(row, j) = component.is_linear() ? change : S(change / scale);
      }
      ++row;
    };
    condition(f);
    for (Index a = 0; a < nu; ++a) {
      Matrix<S> unit = Matrix<S>::Zero(1, nu);
      unit(0, a) = 1;
      Vector<S> slope = Vector<S>::Zero(m);
      gradient.add_times(unit, lanes(slope));
      condition(slope);
    }
    // Momenta turn with space, and do not translate.
    const S size = max_norm(p) * max_norm(v);
    for (Index j = 0; j < columns; ++j) {
      const MomentumComponent<S>& component = components[static_cast<std::size_t>(j)];
      if (!component.is_linear()) rows(row, j) = pair<S>(generator(problem, component, p), v).value / size;
    }
    ++row;
  }
  return rows;
}

}  // namespace

template <Scalar S>
std::vector<MomentumComponent<S>> conserved_momenta(const Problem<S>& problem, const Vector<S>& q) {
  std::vector<MomentumComponent<S>> components = coordinate_momenta(problem);
  // Rotations lead, so that an angular momentum about another point reads L_z + ... P.
  std::stable_partition(components.begin(), components.end(), [](const auto& c) { return !c.is_linear(); });
  // Displacements are differences, and forces may amplify their round-off.
  const S tolerance = S(static_cast<long>(100'000 * problem.m())) * epsilon<S>();
  Matrix<S> basis = null_space(conditions(problem, components, q), tolerance);
  reduce(basis, tolerance);
  std::vector<MomentumComponent<S>> result;
  for (Index n = 0; n < basis.rows(); ++n) {
    MomentumComponent<S> sum{Vector<S>::Zero(components[0].angular.size()), Vector<S>::Zero(problem.dimension)};
    bool led_by_rotation = false;
    for (Index j = 0; j < basis.cols(); ++j) {
      const MomentumComponent<S>& component = components[static_cast<std::size_t>(j)];
      led_by_rotation = led_by_rotation || (basis(n, j) != 0 && !component.is_linear());
      const bool scaled = led_by_rotation && component.is_linear();
      const S weight = near_fraction(scaled ? S(basis(n, j) * extent(q)) : basis(n, j), tolerance);
      sum.angular += weight * component.angular;
      sum.linear += weight * component.linear;
    }
    result.push_back(std::move(sum));
  }
  std::stable_partition(result.begin(), result.end(), [](const auto& c) { return c.is_linear(); });
  return result;
}

#define HBVM_DEFINE(S)                                                                                    \
  template struct MomentumComponent<S>;                                                                   \
  template std::vector<MomentumComponent<S>> coordinate_momenta<S>(const Problem<S>&);                    \
  template MomentumValue<S> momentum<S>(const Problem<S>&, const MomentumComponent<S>&, const Vector<S>&, \
                                        const Vector<S>&);                                                \
  template std::vector<MomentumComponent<S>> conserved_momenta<S>(const Problem<S>&, const Vector<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm

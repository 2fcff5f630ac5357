#include "symmetry_conditions.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

namespace hbvm::core {
namespace {

using UncertainVector = std::vector<Uncertain>;

/// A vector in space that depends on q, x = sum_b weight_b q_b + shift. The motion changes it by w x x + u with u = T t
/// - w x shift. T is the sum of the weights of what translates.
struct Place {
  std::map<Index, Uncertain> weights;  // by the offset of the block
  UncertainVector shift;
  Uncertain translates;
};

/// \tparam S of the problem
template <Scalar S>
class Conditions {
 public:
  Conditions(const Problem<S>& problem, const Mpfr& unit)
      : problem_(problem),
        unit_(unit),
        d_(static_cast<std::size_t>(problem.dimension)),
        rotations_(static_cast<std::size_t>(rotations_in(problem.dimension))) {}

  std::vector<UncertainRow> rows() {
    for (const auto& block : problem_.mass.blocks())
      if (block.full) blocks_stay(block.M);
    for (const EffectTerm<S>& term : problem_.potential.terms) effect(term);
    for (const Constraint<S>& constraint : problem_.constraints)
      std::visit([&](const auto& form) { form.stays(*this); }, constraint.form);
    common_points();
    return std::move(rows_);
  }

  // What forms of constraints ask for: rows of the motions that keep these values at all q.

  /// x.x.
  void length_stays(const Displacement<S>& x) {
    const Place at = place(x);
    if (!at.weights.empty()) center_stays(at);
  }

  /// x_i = 0: seen together with the other components.
  void vanishes(const Displacement<S>& x, Index component) { vanishing_.emplace_back(&x, component); }

  /// n.x.
  void component_stays(const Vector<S>& n, const Displacement<S>& x) { component_stays(vector(n), place(x)); }

  /// x.y changes by u_x.y + u_y.x, where the rotations of both cancel. For each block of coordinates y_b u_x + x_b u_y
  /// = 0, and u_x.(shift of y) + u_y.(shift of x) = 0, where those of w cancel again.
  void product_stays(const Displacement<S>& first, const Displacement<S>& second) {
    const Place x = place(first), y = place(second);
    std::map<Index, std::pair<Uncertain, Uncertain>> blocks;
    for (const auto& [offset, weight] : x.weights) blocks[offset].first = weight;
    for (const auto& [offset, weight] : y.weights) blocks[offset].second = weight;
    for (const auto& [offset, weights] : blocks)
      for (std::size_t i = 0; i < d_; ++i) {
        UncertainRow r = row();
        add_u(r, weights.second, x, i);
        add_u(r, weights.first, y, i);
        add(std::move(r));
      }
    UncertainRow r = row();
    for (std::size_t i = 0; i < d_; ++i) t(r, i) = x.translates * y.shift[i] + y.translates * x.shift[i];
    add(std::move(r));
  }

  /// The sum is over blocks of q_a^T A_ab q_b and b_a.q_a. It changes by the sum of q_a^T (A_ab w - w A_ab) q_b, q_a.(2
  /// A_ab t + b_a x w) and b_a.t, with t for what translates.
  void quadratic_stays(const std::vector<Index>& blocks, const Matrix<S>& A, const Vector<S>& linear) {
    blocks_stay(A);
    const Index d = problem_.dimension;
    UncertainRow all = row();
    for (std::size_t a = 0; a < blocks.size(); ++a) {
      const Index first = static_cast<Index>(a) * d;
      const UncertainVector b = vector(linear.segment(first, d));
      for (Index i = 0; i < d; ++i) {
        UncertainRow r = row();
        for (std::size_t other = 0; other < blocks.size(); ++other) {
          if (!translates(blocks[other])) continue;
          for (Index j = 0; j < d; ++j) {
            Uncertain& c = t(r, static_cast<std::size_t>(j));
            c = c + 2 * number(A(first + i, static_cast<Index>(other) * d + j));
          }
        }
        for (std::size_t k = 0; k < rotations_; ++k) w(r, k) = -turned(k, b)[static_cast<std::size_t>(i)];
        add(std::move(r));
      }
      for (std::size_t i = 0; translates(blocks[a]) && i < d_; ++i) t(all, i) = t(all, i) + b[i];
    }
    add(std::move(all));
  }

  /// A formula, U or g.
  void effect(const EffectTerm<S>& term) {
    for (Index i = 0; i < term.symmetry.conditions.rows(); ++i) {
      UncertainRow r = row();
      for (std::size_t j = 0; j < r.size(); ++j) r[j] = number(term.symmetry.conditions(i, static_cast<Index>(j)));
      add(std::move(r));
    }
    if (term.symmetry.kind == Symmetry::computed) return;
    for (std::size_t n = 0; n < term.displacements.size(); ++n) {
      if (!term.symmetry.acts[n]) continue;
      const Place x = place(term.displacements[n]);
      if (x.weights.empty()) continue;  // nothing that moves
      if (term.symmetry.kind != Symmetry::planar) center_stays(x);
      if (term.symmetry.kind == Symmetry::central) continue;
      UncertainVector axis = zero();
      for (std::size_t i = 0; i < d_; ++i) {
        const auto at = [&](const Matrix<S>& values) {
          return number(values(static_cast<Index>(n), static_cast<Index>(i))).value;
        };
        axis[i] = {at(term.symmetry.axes), at(term.symmetry.axis_round_off)};
      }
      if (term.symmetry.kind == Symmetry::axial)
        axis_stays(axis);
      else
        component_stays(axis, x);
    }
  }

 private:
  Uncertain number(const S& x) const {
    const Mpfr value = rounded_to<Mpfr>(raw(exactly(x)));
    return {value, unit_ * magnitude(value)};
  }
  UncertainVector vector(const Vector<S>& v) const {
    UncertainVector result(d_);
    for (Index i = 0; i < v.size(); ++i) result[static_cast<std::size_t>(i)] = number(v[i]);
    return result;
  }
  UncertainVector zero() const { return UncertainVector(d_); }

  Place place(const Displacement<S>& x) const {
    Place result;
    result.shift = vector(x.shift);
    // Weights that are whole are exact: differences of positions are free of t.
    const auto weight = [&](const S& value) {
      using std::floor;
      return floor(value) == value ? Uncertain(number(value).value, 0) : number(value);
    };
    for (const auto& block : x.blocks) {
      Uncertain& sum = result.weights[block.offset];
      sum = sum + weight(block.weight);
      if (translates(block.offset)) result.translates = result.translates + weight(block.weight);
    }
    std::erase_if(result.weights, [](const auto& entry) { return entry.second.holds_zero(); });
    return result;
  }
  bool translates(Index offset) const {
    const auto at = std::find_if(problem_.blocks.begin(), problem_.blocks.end(),
                                 [&](const SpaceBlock& block) { return block.offset == offset; });
    return at != problem_.blocks.end() && at->translates;
  }

  /// Axis k turns coordinate `from` to `to`.
  std::pair<std::size_t, std::size_t> turn(std::size_t k) const {
    return d_ == 2 ? std::pair<std::size_t, std::size_t>(0, 1) : std::pair((k + 1) % 3, (k + 2) % 3);
  }
  /// e_k x v.
  UncertainVector turned(std::size_t k, const UncertainVector& v) const {
    UncertainVector result = zero();
    const auto [from, to] = turn(k);
    result[to] = v[from];
    result[from] = -v[to];
    return result;
  }

  UncertainRow row() const { return UncertainRow(rotations_ + d_); }
  Uncertain& w(UncertainRow& row, std::size_t k) const { return row[k]; }
  Uncertain& t(UncertainRow& row, std::size_t i) const { return row[rotations_ + i]; }
  void add(UncertainRow row) {
    if (std::any_of(row.begin(), row.end(), [](const Uncertain& x) { return !x.holds_zero(); }))
      rows_.push_back(std::move(row));
  }

  /// c u_x, component i, added to a row.
  void add_u(UncertainRow& row, const Uncertain& c, const Place& x, std::size_t i) const {
    t(row, i) = t(row, i) + c * x.translates;
    for (std::size_t k = 0; k < rotations_; ++k) w(row, k) = w(row, k) - c * turned(k, x.shift)[i];
  }

  /// x.(u) changes x.x at all x: u = 0.
  void center_stays(const Place& x) {
    for (std::size_t i = 0; i < d_; ++i) {
      UncertainRow r = row();
      add_u(r, 1, x, i);
      add(std::move(r));
    }
  }

  /// n x w = 0.
  void axis_stays(const UncertainVector& n) {
    for (std::size_t i = 0; i < d_; ++i) {
      UncertainRow r = row();
      for (std::size_t k = 0; k < rotations_; ++k) w(r, k) = turned(k, n)[i];
      add(std::move(r));
    }
  }

  /// n.(w x x + u) = 0 at all x.
  void component_stays(const UncertainVector& n, const Place& x) {
    axis_stays(n);
    UncertainRow r = row();
    for (std::size_t i = 0; i < d_; ++i) add_u(r, n[i], x, i);
    add(std::move(r));
  }

  /// A w - w A = 0 with w as the matrix of the product w x.
  void matrix_stays(const Matrix<S>& A) {
    for (std::size_t i = 0; i < d_; ++i)
      for (std::size_t j = 0; j < d_; ++j) {
        UncertainRow r = row();
        for (std::size_t k = 0; k < rotations_; ++k) {
          // The matrix of axis k is 1 at (to, from) and -1 at (from, to).
          const auto [from, to] = turn(k);
          const auto entry = [&](std::size_t a, std::size_t b) {
            return number(A(static_cast<Index>(a), static_cast<Index>(b)));
          };
          Uncertain& c = w(r, k);
          if (j == from) c = c + entry(i, to);
          if (j == to) c = c - entry(i, from);
          if (i == to) c = c - entry(from, j);
          if (i == from) c = c + entry(to, j);
        }
        add(std::move(r));
      }
  }

  /// The blocks of M, or of another quadratic form, act alike in all directions that the motion joins.
  void blocks_stay(const Matrix<S>& M) {
    const Index d = problem_.dimension;
    for (Index a = 0; a < M.rows(); a += d)
      for (Index b = a; b < M.cols(); b += d) matrix_stays(M.block(a, b, d, d));
  }

  /// A rotation mixes the components of x = 0, so that all together stay where one does not. Those set aside follow
  /// from the others, and count.
  void common_points() {
    std::vector<std::pair<const Displacement<S>*, Index>> all = vanishing_;
    for (const RedundantConstraint<S>& redundant : problem_.redundant)
      if (const auto* form = std::get_if<CommonPoint<S>>(&redundant.constraint.form))
        all.emplace_back(&form->x, form->component);
    for (const auto& [x, component] : vanishing_) {
      std::set<Index> components;
      for (const auto& [y, other] : all)
        if (is_same(*x, *y)) components.insert(other);
      if (components.size() == d_)
        length_stays(*x);
      else
        component_stays(Vector<S>(Vector<S>::Unit(problem_.dimension, component)), *x);
    }
  }

  const Problem<S>& problem_;
  Mpfr unit_;
  std::size_t d_, rotations_;
  std::vector<std::pair<const Displacement<S>*, Index>> vanishing_;
  std::vector<UncertainRow> rows_;
};

}  // namespace

template <Scalar S>
std::vector<UncertainRow> symmetry_conditions(const Problem<S>& problem, const Mpfr& unit) {
  return Conditions<S>(problem, unit).rows();
}

#define HBVM_DEFINE(S) template std::vector<UncertainRow> symmetry_conditions<S>(const Problem<S>&, const Mpfr&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

#include "hbvm/problem/formula/symmetry.hpp"

#include <algorithm>
#include <optional>
#include <set>

#include "hbvm/linear/null_space.hpp"
#include "hbvm/problem/effect/execution.hpp"
#include "scalar/expression_node.hpp"

namespace hbvm {
namespace {

/// Numbers from -1 to 1 without a pattern, the same in each run.
class Spread {
 public:
  Mpfr next() {
    state_ = state_ * 1'103'515'245 + 12'345;
    return Mpfr(static_cast<int>(state_ >> 16U & 0x7fffU) - 0x4000) / 0x4000;
  }

 private:
  std::uint32_t state_ = 1;
};

/// While it lives, this thread's numbers have the widest range of exponents there is: bumps that are narrow and far
/// away are still felt.
class WidestRange {
 public:
  WidestRange() {
    mpfr_set_emin(mpfr_get_emin_min());
    mpfr_set_emax(mpfr_get_emax_max());
  }
  ~WidestRange() {
    mpfr_set_emin(least_);
    mpfr_set_emax(greatest_);
  }
  WidestRange(const WidestRange&) = delete;

 private:
  mpfr_exp_t least_ = mpfr_get_emin(), greatest_ = mpfr_get_emax();
};

/// The equations that one instance puts up, for its points.
class Sampling {
 public:
  /// \param is_number U varies with nothing
  Sampling(const EffectTerm<Mpfr>& term, const std::vector<SpaceBlock>& blocks, Index dimension, bool is_number)
      : term_(term), blocks_(blocks), d_(dimension), rotations_(dimension == 2 ? 1 : 3), is_number_(is_number) {}

  std::size_t rotations() const { return static_cast<std::size_t>(rotations_); }
  std::size_t columns() const { return static_cast<std::size_t>(rotations_ + d_); }

  /// The equation at q; none where the gradient has no value.
  std::optional<UncertainRow> row(Index instance, const Vector<Mpfr>& q) const {
    Matrix<Mpfr> x(1, term_.arguments * d_);
    for (Index a = 0; a < term_.arguments; ++a)
      x.block(0, a * d_, 1, d_) = displaced(term_.displacement(instance, a), d_, q).transpose();
    const Matrix<Mpfr> coefficients = term_.gradient_coefficients.row(instance);
    Execution<Mpfr> gradient(term_.gradient, coefficients, x, 1);
    gradient.run();
    UncertainRow result(columns());
    Mpfr force = 0, reach = 0;
    for (Index a = 0; a < term_.arguments; ++a) {
      const Vector<Mpfr> at = moved(term_.displacement(instance, a), d_, q);
      raise_to(reach, max_norm(at));
      const Mpfr T = translation(term_.displacement(instance, a));
      for (Index i = 0; i < d_; ++i) {
        const Mpfr& g = gradient.output(a * d_ + i, 0);
        if (!is_finite(g)) return std::nullopt;
        raise_to(force, magnitude(g));
        result[static_cast<std::size_t>(rotations_ + i)].value += T * g;
        for (Index k = 0; k < rotations_; ++k) result[static_cast<std::size_t>(k)].value += g * turned(k, at)[i];
      }
    }
    force_ = force;
    for (std::size_t j = 0; j < columns(); ++j) {
      const Mpfr size = j < rotations() ? Mpfr(force * reach) : force;
      result[j].error = size * sqrt(epsilon<Mpfr>());
    }
    return result;
  }

  /// Whether there was a force at the last point, or U is a number.
  bool felt() const { return force_ > 0 || is_number_; }
  /// Its greatest component there.
  const Mpfr& force() const { return force_; }

  /// What the equations of an instance depend on, where its displacements can be any vectors: its parameters, and the
  /// T_a. Nothing where they cannot.
  std::vector<Mpfr> signature(const FormulaUse<Mpfr>::Instance& instance) const {
    std::vector<Mpfr> result = instance.parameters;
    std::set<Index> seen;
    for (const Displacement<Mpfr>& x : instance.x) {
      if (x.shift.size() > 0 || x.blocks.empty()) return {};
      for (const auto& block : x.blocks)
        if (!seen.insert(block.offset).second) return {};
      result.push_back(translation(x));
    }
    return result;
  }

 private:
  /// T_a.
  Mpfr translation(const Displacement<Mpfr>& x) const {
    Mpfr sum = 0;
    for (const auto& block : x.blocks)
      if (translates(block.offset)) sum += block.weight;
    return sum;
  }
  bool translates(Index offset) const {
    const auto at =
        std::find_if(blocks_.begin(), blocks_.end(), [&](const auto& block) { return block.offset == offset; });
    return at != blocks_.end() && at->translates;
  }

  /// e_k x v.
  Vector<Mpfr> turned(Index k, const Vector<Mpfr>& v) const {
    Vector<Mpfr> result = Vector<Mpfr>::Zero(d_);
    const Index from = d_ == 2 ? 0 : (k + 1) % 3, to = d_ == 2 ? 1 : (k + 2) % 3;
    result[to] = v[from];
    result[from] = -v[to];
    return result;
  }

  const EffectTerm<Mpfr>& term_;
  const std::vector<SpaceBlock>& blocks_;
  Index d_, rotations_;
  bool is_number_;
  mutable Mpfr force_ = 0;
};

/// What an instance puts up, and the greatest force at its points.
struct Sample {
  std::vector<UncertainRow> rows;
  Mpfr force = 0;
};

/// Some equations more than there are unknowns, at points in a region about q where U has a gradient.
Sample sample(const Sampling& sampling, Index instance, const Vector<Mpfr>& q) {
  constexpr int most_halvings = 60;
  const std::size_t count = sampling.columns() + 2;
  const Mpfr size = max_norm(q);
  Mpfr radius = (size == 0 ? Mpfr(1) : size) / 8;
  for (int halvings = 0; halvings < most_halvings; ++halvings, radius /= 2) {
    Spread spread;
    Sample found;
    while (found.rows.size() < count) {
      Vector<Mpfr> near = q;
      for (Index j = 0; j < q.size(); ++j) near[j] += radius * spread.next();
      auto row = sampling.row(instance, near);
      if (!row || !sampling.felt()) break;
      raise_to(found.force, sampling.force());
      found.rows.push_back(std::move(*row));
    }
    if (found.rows.size() == count) return found;
  }
  // Nowhere around has it a gradient that is felt: nothing is said to keep it.
  Sample nothing;
  for (std::size_t j = 0; j < sampling.columns(); ++j) {
    nothing.rows.emplace_back(sampling.columns());
    nothing.rows.back()[j] = 1;
  }
  return nothing;
}

using NodePtr = std::shared_ptr<const Expression::Node>;

/// Whether nothing in it varies.
bool holds_no_variable(const NodePtr& node, const FormulaVariables& variables) {
  if (!node) return true;
  const bool varies = node->kind == Expression::Node::Kind::name && variables.contains(node->text);
  return !varies && holds_no_variable(node->left, variables) && holds_no_variable(node->right, variables);
}

/// Whether a function in it may be smaller than any number of digits tells.
bool may_vanish(const NodePtr& node) {
  using Kind = Expression::Node::Kind;
  if (!node) return false;
  const bool is_exponential =
      node->kind == Kind::exp || node->kind == Kind::sinh || node->kind == Kind::cosh || node->kind == Kind::tanh;
  return is_exponential || may_vanish(node->left) || may_vanish(node->right);
}

/// Those terms of a sum that may be nothing beside the others where it is looked at, and not elsewhere.
void add_weak_terms(const Expression& sum, const NodePtr& node, std::vector<Expression>& terms) {
  using Kind = Expression::Node::Kind;
  if (node->kind == Kind::add || node->kind == Kind::subtract || node->kind == Kind::negate) {
    for (const NodePtr& part : {node->left, node->right})
      if (part) add_weak_terms(sum, part, terms);
  } else if (node != sum.root() && may_vanish(node)) {
    terms.push_back(sum.part(node));
  }
}

/// The equations of all instances of a formula, and of each of its terms that is not seen beside the others.
std::vector<UncertainRow> all_rows(const FormulaUse<Mpfr>& use, const std::vector<SpaceBlock>& blocks,
                                   const Vector<Mpfr>& q) {
  const EffectTerm<Mpfr> whole = make_term(use);
  const Sampling sampling(whole, blocks, use.dimension, holds_no_variable(use.formula.root(), use.variables));
  std::vector<Expression> weak;
  add_weak_terms(use.formula, use.formula.root(), weak);
  std::vector<EffectTerm<Mpfr>> terms;
  for (const Expression& term : weak)
    if (!holds_no_variable(term.root(), use.variables))
      terms.push_back(make_term(FormulaUse<Mpfr>{term, use.constants, use.dimension, use.arguments, use.variables,
                                                 use.parameters, use.instances}));
  std::vector<UncertainRow> rows;
  std::set<std::vector<Mpfr>> seen;
  for (std::size_t n = 0; n < use.instances.size(); ++n) {
    const std::vector<Mpfr> signature = sampling.signature(use.instances[n]);
    if (!signature.empty() && !seen.insert(signature).second) continue;
    const Sample all = sample(sampling, static_cast<Index>(n), q);
    rows.insert(rows.end(), all.rows.begin(), all.rows.end());
    for (const EffectTerm<Mpfr>& term : terms) {
      const Sample part = sample(Sampling(term, blocks, use.dimension, false), static_cast<Index>(n), q);
      if (part.force < sqrt(epsilon<Mpfr>()) * all.force) rows.insert(rows.end(), part.rows.begin(), part.rows.end());
    }
  }
  return rows;
}

}  // namespace

template <Scalar S>
EffectSymmetry<S> formula_symmetry(const FormulaUse<S>& use, const std::vector<SpaceBlock>& blocks,
                                   const Vector<S>& q) {
  EffectSymmetry<S> result;
  result.kind = Symmetry::computed;
  result.acts.assign(use.instances.size(), true);
  const auto digits = static_cast<unsigned>(digits10<S>());
  std::vector<std::vector<BigFloat>> conditions;
  std::size_t columns = 0;
  {
    const PrecisionScope many(2 * digits + 700);
    const WidestRange widest;
    Vector<Mpfr> start(q.size());
    for (Index j = 0; j < q.size(); ++j) start[j] = rounded_to<Mpfr>(raw(exactly(q[j])));
    const auto rotations = static_cast<std::size_t>(use.dimension == 2 ? 1 : 3);
    columns = rotations + static_cast<std::size_t>(use.dimension);
    // What is across the motions that keep it says the same in as few equations as there can be.
    for (const UncertainRow& row :
         null_space(null_space(all_rows(exactly(use), blocks, start), columns, rotations), columns, rotations)) {
      // Of a force of short range they may be beyond the range of S; their sizes say nothing.
      Mpfr greatest = 0;
      for (const Uncertain& x : row)
        if (!x.holds_zero()) raise_to(greatest, magnitude(x.value));
      conditions.emplace_back();
      for (const Uncertain& x : row)
        conditions.back().push_back(exactly(x.holds_zero() ? Mpfr(0) : Mpfr(x.value / greatest)));
    }
  }
  result.conditions.resize(static_cast<Index>(conditions.size()), static_cast<Index>(columns));
  for (std::size_t i = 0; i < conditions.size(); ++i)
    for (std::size_t j = 0; j < columns; ++j)
      result.conditions(static_cast<Index>(i), static_cast<Index>(j)) = rounded_to<S>(raw(conditions[i][j]));
  return result;
}

#define HBVM_DEFINE(S)                                                                                 \
  template EffectSymmetry<S> formula_symmetry<S>(const FormulaUse<S>&, const std::vector<SpaceBlock>&, \
                                                 const Vector<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm

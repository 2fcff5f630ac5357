#include "problem/formula/symmetry.hpp"

#include <algorithm>
#include <optional>
#include <set>

#include "linear/null_space.hpp"
#include "problem/effect/execution.hpp"
#include "softening.hpp"

namespace hbvm::core {
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

/// The equations that one instance puts up, for its points.
class Sampling {
 public:
  Sampling(const EffectTerm<Mpfr>& term, const std::vector<SpaceBlock>& blocks, Index dimension)
      : term_(term), blocks_(blocks), d_(dimension), rotations_(rotations_in(dimension)) {}

  std::size_t rotations() const { return static_cast<std::size_t>(rotations_); }
  std::size_t columns() const { return static_cast<std::size_t>(rotations_ + d_); }

  /// The equation at q, and that of softened exponents if they are large. \return whether the gradient has a value
  bool add_rows(Index instance, const Vector<Mpfr>& q, std::vector<UncertainRow>& rows) const {
    const std::optional<Program<Mpfr>> softened = softened_gradient(instance, q);
    for (const Program<Mpfr>* gradient : {&term_.gradient, softened ? &*softened : nullptr}) {
      if (!gradient) continue;
      std::optional<UncertainRow> found = row(*gradient, instance, q);
      if (!found) return false;
      rows.push_back(std::move(*found));
    }
    return true;
  }

  /// What the equations of an instance depend on, where its displacements can be any vectors: its parameters, and the
  /// T_a. Nothing where they cannot.
  std::vector<Mpfr> signature(const FormulaInput<Mpfr>::Instance& instance) const {
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
  /// The gradient with exponents that are not far from 0 at q. \return nothing if they are not far as it is
  std::optional<Program<Mpfr>> softened_gradient(Index instance, const Vector<Mpfr>& q) const {
    const Program<Mpfr> as_it_is = with_exponents_times(Mpfr(1), term_.gradient);
    if (as_it_is.outputs() == term_.gradient.outputs()) return std::nullopt;
    const Matrix<Mpfr> found = outputs(as_it_is, instance, q);
    Mpfr greatest = 0;
    for (Index i = static_cast<Index>(term_.gradient.outputs()); i < found.cols(); ++i)
      raise_to(greatest, magnitude(found(0, i)));
    constexpr int far = 64;
    if (!(greatest > far && is_finite(greatest))) return std::nullopt;
    return with_exponents_times(far / greatest, term_.gradient);
  }

  /// The equation at q, by this program of the gradient; none where it has no value.
  std::optional<UncertainRow> row(const Program<Mpfr>& code, Index instance, const Vector<Mpfr>& q) const {
    const Matrix<Mpfr> gradient = outputs(code, instance, q);
    UncertainRow result(columns());
    Mpfr force = 0, reach = 0;
    for (Index a = 0; a < term_.arguments; ++a) {
      const Vector<Mpfr> at = moved(term_.displacement(instance, a), d_, q);
      raise_to(reach, max_norm(at));
      const Mpfr T = translation(term_.displacement(instance, a));
      for (Index i = 0; i < d_; ++i) {
        const Mpfr& g = gradient(0, a * d_ + i);
        if (!is_finite(g)) return std::nullopt;
        raise_to(force, magnitude(g));
        result[static_cast<std::size_t>(rotations_ + i)].value += T * g;
        for (Index k = 0; k < rotations_; ++k) result[static_cast<std::size_t>(k)].value += g * turned(k, at)[i];
      }
    }
    for (std::size_t j = 0; j < columns(); ++j) {
      const Mpfr size = j < rotations() ? Mpfr(force * reach) : force;
      result[j].error = size * sqrt(epsilon<Mpfr>());
    }
    return result;
  }

  Matrix<Mpfr> outputs(const Program<Mpfr>& code, Index instance, const Vector<Mpfr>& q) const {
    return outputs_of<Mpfr>(code, term_.gradient_coefficients.row(instance),
                            displaced(term_, instance, d_, q).transpose());
  }
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
};

/// Some equations more than there are unknowns, at points in a region about q where U has a gradient.
void sample(const Sampling& sampling, Index instance, const Vector<Mpfr>& q, std::vector<UncertainRow>& rows) {
  constexpr int most_halvings = 60;
  const std::size_t points = sampling.columns() + 2;
  const Mpfr size = max_norm(q);
  Mpfr radius = (size == 0 ? Mpfr(1) : size) / 8;
  for (int halvings = 0; halvings < most_halvings; ++halvings, radius /= 2) {
    Spread spread;
    std::vector<UncertainRow> found;
    bool has_values = true;
    for (std::size_t n = 0; n < points && has_values; ++n) {
      Vector<Mpfr> near = q;
      for (Index j = 0; j < q.size(); ++j) near[j] += radius * spread.next();
      has_values = sampling.add_rows(instance, near, found);
    }
    if (!has_values) continue;
    rows.insert(rows.end(), found.begin(), found.end());
    return;
  }
  // Nowhere around has it a gradient: nothing is said to keep it.
  for (std::size_t j = 0; j < sampling.columns(); ++j) {
    rows.emplace_back(sampling.columns());
    rows.back()[j] = 1;
  }
}

}  // namespace

template <Scalar S>
EffectSymmetry<S> formula_symmetry(const FormulaInput<S>& input, const std::vector<SpaceBlock>& blocks,
                                   const Vector<S>& q) {
  EffectSymmetry<S> result;
  result.kind = Symmetry::computed;
  result.acts.assign(input.instances.size(), true);
  const auto digits = static_cast<unsigned>(digits10<S>());
  std::vector<std::vector<BigFloat>> conditions;
  std::size_t columns = 0;
  {
    const PrecisionScope many(2 * digits + 700);
    const FormulaInput<Mpfr> exact = exactly(input);
    const EffectTerm<Mpfr> term = make_term(exact);
    const Sampling sampling(term, blocks, input.dimension);
    columns = sampling.columns();
    Vector<Mpfr> start(q.size());
    for (Index j = 0; j < q.size(); ++j) start[j] = rounded_to<Mpfr>(raw(exactly(q[j])));
    std::vector<UncertainRow> rows;
    std::set<std::vector<Mpfr>> seen;
    for (std::size_t n = 0; n < exact.instances.size(); ++n) {
      const std::vector<Mpfr> signature = sampling.signature(exact.instances[n]);
      if (signature.empty() || seen.insert(signature).second) sample(sampling, static_cast<Index>(n), start, rows);
    }
    // What is across the motions that keep it says the same in as few equations as there can be.
    for (const UncertainRow& row :
         null_space(null_space(std::move(rows), columns, sampling.rotations()), columns, sampling.rotations())) {
      conditions.emplace_back();
      for (const Uncertain& x : row) conditions.back().push_back(exactly(x.holds_zero() ? Mpfr(0) : x.value));
    }
  }
  result.conditions.resize(static_cast<Index>(conditions.size()), static_cast<Index>(columns));
  for (std::size_t i = 0; i < conditions.size(); ++i)
    for (std::size_t j = 0; j < columns; ++j)
      result.conditions(static_cast<Index>(i), static_cast<Index>(j)) = rounded_to<S>(raw(conditions[i][j]));
  return result;
}

#define HBVM_DEFINE(S)                                                                                   \
  template EffectSymmetry<S> formula_symmetry<S>(const FormulaInput<S>&, const std::vector<SpaceBlock>&, \
                                                 const Vector<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

#include "problem/formula/quadratic.hpp"

#include <algorithm>
#include <memory>
#include <set>

#include "linear/rounded.hpp"
#include "problem/effect/execution.hpp"

namespace hbvm::core {
namespace {

/// g = x^T A x + b^T x + c.
struct Quadratic {
  Matrix<Mpfr> A;
  Vector<Mpfr> b;
  Mpfr c;
};

Vector<Mpfr> at_origin(const Program<Mpfr>& program, const Matrix<Mpfr>& coefficients, Index inputs) {
  return outputs_of<Mpfr>(program, coefficients, Matrix<Mpfr>::Zero(1, inputs)).transpose();
}

/// Of the displacements, one after the other.
Quadratic by_displacements(const EffectTerm<Mpfr>& term, Index inputs) {
  Quadratic g{Matrix<Mpfr>(inputs, inputs), at_origin(term.gradient, term.gradient_coefficients, inputs),
              at_origin(term.value, term.value_coefficients, inputs)[0]};
  const Vector<Mpfr> second = at_origin(term.hessian, term.hessian_coefficients, inputs);
  for (Index i = 0, k = 0; i < inputs; ++i)
    for (Index j = 0; j <= i; ++j, ++k) g.A(i, j) = g.A(j, i) = second[k] / 2;
  return g;
}

/// sum_j a(i, j) x_j.
Mpfr row_times(const Matrix<Mpfr>& a, Index i, const Vector<Mpfr>& x) {
  Mpfr sum = 0;
  for (Index j = 0; j < x.size(); ++j) sum += a(i, j) * x[j];
  return sum;
}

/// x = sum_a weight_a x_a + s with g = |x|^2 - square.
struct Length {
  std::vector<int> weights;
  Vector<Mpfr> s;
  Mpfr square;
};
std::optional<Length> as_length(const Quadratic& g, Index d) {
  const Index arguments = g.b.size() / d;
  Length found{{}, Vector<Mpfr>::Zero(d), {}};
  // The first that occurs has the weight 1.
  Index first = 0;
  while (first < arguments && g.A(first * d, first * d) == 0) ++first;
  if (first == arguments) return std::nullopt;
  for (Index a = 0; a < arguments; ++a) {
    const Mpfr& weight = g.A(a * d, first * d);
    if (weight != 0 && magnitude(weight) != 1) return std::nullopt;
    found.weights.push_back(weight == 0 ? 0 : weight > 0 ? 1 : -1);
  }
  for (Index i = 0; i < g.b.size(); ++i)
    for (Index j = 0; j < g.b.size(); ++j) {
      const int product =
          found.weights[static_cast<std::size_t>(i / d)] * found.weights[static_cast<std::size_t>(j / d)];
      if (g.A(i, j) != (i % d == j % d ? product : 0)) return std::nullopt;
    }
  found.s = g.b.segment(first * d, d) / Mpfr(2);
  for (Index i = 0; i < g.b.size(); ++i)
    if (g.b[i] != 2 * found.weights[static_cast<std::size_t>(i / d)] * found.s[i % d]) return std::nullopt;
  found.square = -g.c;
  for (Index i = 0; i < d; ++i) found.square += found.s[i] * found.s[i];
  return found.square > 0 ? std::optional<Length>(found) : std::nullopt;
}

/// The sum of the displacements that a length is of.
Displacement<Mpfr> sum_of(const Length& length, const std::vector<Displacement<Mpfr>>& x, Index d) {
  Displacement<Mpfr> sum;
  Vector<Mpfr> shift = length.s;
  for (std::size_t a = 0; a < x.size(); ++a) {
    if (length.weights[a] == 0) continue;
    for (const auto& block : x[a].blocks) {
      const Mpfr weight = length.weights[a] * block.weight;
      const auto same = [&](const auto& other) { return other.offset == block.offset; };
      const auto known = std::find_if(sum.blocks.begin(), sum.blocks.end(), same);
      if (known == sum.blocks.end())
        sum.blocks.push_back({block.offset, weight});
      else
        known->weight += weight;
    }
    for (Index i = 0; i < x[a].shift.size(); ++i) shift[i] += length.weights[a] * x[a].shift[i];
  }
  std::erase_if(sum.blocks, [](const auto& block) { return block.weight == 0; });
  if (shift != Vector<Mpfr>::Zero(d)) sum.shift = shift;
  return sum;
}

/// g of the coordinates that the displacements are made of, block after block: x = L q + s.
Quadratic by_coordinates(const Quadratic& g, const std::vector<Displacement<Mpfr>>& x, const std::vector<Index>& blocks,
                         Index d) {
  const Index inputs = g.b.size(), m = static_cast<Index>(blocks.size()) * d;
  Matrix<Mpfr> L = Matrix<Mpfr>::Zero(inputs, m);
  Vector<Mpfr> s = Vector<Mpfr>::Zero(inputs);
  for (Index i = 0; i < inputs; ++i) {
    const Displacement<Mpfr>& from = x[static_cast<std::size_t>(i / d)];
    for (const auto& block : from.blocks) {
      const auto place = std::lower_bound(blocks.begin(), blocks.end(), block.offset) - blocks.begin();
      L(i, place * d + i % d) += block.weight;
    }
    if (from.shift.size() > 0) s[i] = from.shift[i % d];
  }
  Quadratic result{Matrix<Mpfr>::Zero(m, m), Vector<Mpfr>::Zero(m), g.c};
  for (Index i = 0; i < inputs; ++i) {
    const Mpfr A_s = row_times(g.A, i, s);
    result.c += s[i] * (g.b[i] + A_s);
    for (Index k = 0; k < m; ++k) {
      if (L(i, k) == 0) continue;
      result.b[k] += L(i, k) * (g.b[i] + 2 * A_s);
      for (Index j = 0; j < inputs; ++j)
        for (Index l = 0; l < m; ++l) result.A(k, l) += L(i, k) * g.A(i, j) * L(j, l);
    }
  }
  return result;
}

/// What a formula is, in many digits.
struct Found {
  std::optional<Length> length;
  Displacement<Mpfr> x;       ///< whose length it is
  std::vector<Index> blocks;  ///< or the coordinates of g
  Quadratic g;
};

/// None if g is not quadratic.
std::unique_ptr<const Found> find(const FormulaInput<Mpfr>& input) {
  const Index d = input.dimension;
  const EffectTerm<Mpfr> term = make_term(input);
  if (term.degree < 0 || term.degree > 2) return nullptr;
  auto found = std::make_unique<Found>();
  const std::vector<Displacement<Mpfr>>& x = input.instances.front().x;
  found->g = by_displacements(term, input.arguments * d);
  found->length = as_length(found->g, d);
  if (found->length) {
    found->x = sum_of(*found->length, x, d);
    return found;
  }
  std::set<Index> offsets;
  for (const auto& displacement : x)
    for (const auto& block : displacement.blocks) offsets.insert(block.offset);
  found->blocks.assign(offsets.begin(), offsets.end());
  found->g = by_coordinates(found->g, x, found->blocks, d);
  return found;
}

}  // namespace

template <Scalar S>
std::optional<ConstraintForms<S>> quadratic_form(const FormulaInput<S>& input) {
  std::unique_ptr<const Found> found;
  {
    // For what cancels in sums of products; rounded to the digits of S below, once.
    const PrecisionScope more(4 * static_cast<unsigned>(digits10<S>()) + 20);
    found = find(exactly(input));
  }
  if (!found) return std::nullopt;
  if (found->length) {
    Rod<S> rod{{}, rounded_to<S>(raw(found->length->square))};
    for (const auto& block : found->x.blocks) rod.x.blocks.push_back({block.offset, rounded_to<S>(raw(block.weight))});
    rod.x.shift = rounded<S>(found->x.shift);
    return rod;
  }
  const Quadratic& g = found->g;
  const bool linear = std::all_of(g.A.data(), g.A.data() + g.A.size(), [](const Mpfr& a) { return a == 0; });
  if (linear && found->blocks.size() == 1) {
    Plane<S> plane{found->blocks, rounded<S>(g.b), rounded_to<S>(raw(g.c))};
    plane.offset = -plane.offset;
    return plane;
  }
  return Quadric<S>{found->blocks, rounded<S>(g.A), rounded<S>(g.b), rounded_to<S>(raw(g.c))};
}

#define HBVM_DEFINE(S) template std::optional<ConstraintForms<S>> quadratic_form<S>(const FormulaInput<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

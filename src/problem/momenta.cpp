#include "problem/momenta.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "linear/null_space.hpp"
#include "symmetry_conditions.hpp"

namespace hbvm::core {
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

/// x rounded to so many bits if that is within the bound `error`: what the author of a scene may have written.
std::optional<Mpfr> short_number(const Mpfr& x, const Mpfr& error, int bits) {
  BigFloat rounded(bits);
  mpfr_set(raw(rounded), raw(x), MPFR_RNDN);
  Mpfr result = rounded_to<Mpfr>(raw(rounded));
  if (magnitude(Mpfr(result - x)) > error) return std::nullopt;
  return result;
}

/// The fraction of a short number and a small denominator that x may be, or x. It is the same in any units that are
/// powers of two.
Mpfr near_fraction(const Uncertain& x, int bits) {
  for (int denominator = 1; denominator <= 20; ++denominator)
    if (const auto multiple = short_number(x.value * denominator, x.error * denominator, bits))
      return *multiple / denominator;
  return x.value;
}

}  // namespace

template <Scalar S>
std::string MomentumComponent<S>::name() const {
  std::string text;
  const auto add = [&](const Vector<S>& coefficients, const char* what, Index first_axis) {
    for (Index i = 0; i < coefficients.size(); ++i) {
      if (coefficients[i] == 0) continue;
      const double c = approximately(coefficients[i]);
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
  const Index d = problem.dimension, rotations = rotations_in(d);
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

/// The coefficients of the components that conserved_momenta() finds: the angular ones, then the linear ones.
template <Scalar S>
std::vector<std::vector<BigFloat>> conserved_coefficients(const Problem<S>& problem, std::size_t rotations,
                                                          std::size_t columns, bool translates) {
  const S unit = epsilon<S>();
  const int half_the_bits = significand_bits<S>() / 2, digits = digits10<S>();
  const PrecisionScope guarded(static_cast<unsigned>(2 * digits + 20));
  std::vector<UncertainRow> conditions = symmetry_conditions(problem, rounded_to<Mpfr>(raw(exactly(unit))));
  for (std::size_t j = rotations; j < columns && !translates; ++j) {
    conditions.emplace_back(columns);
    conditions.back()[j] = 1;
  }
  std::vector<std::vector<BigFloat>> result;
  for (const UncertainRow& row : null_space(std::move(conditions), columns, rotations)) {
    result.emplace_back();
    for (const Uncertain& x : row) result.back().push_back(exactly(near_fraction(x, half_the_bits)));
  }
  return result;
}

}  // namespace

template <Scalar S>
std::vector<MomentumComponent<S>> conserved_momenta(const Problem<S>& problem) {
  // Forces without a potential, and points that are moved, pull from outside.
  if (!problem.is_conservative()) return {};
  const MomentumComponent<S> last = coordinate_momenta(problem).back();
  const bool translates = coordinate_momenta(problem).front().is_linear();
  const Index rotations = last.angular.size(), columns = rotations + last.linear.size();
  std::vector<MomentumComponent<S>> result;
  for (const auto& coefficients : conserved_coefficients(problem, static_cast<std::size_t>(rotations),
                                                         static_cast<std::size_t>(columns), translates)) {
    MomentumComponent<S> component{Vector<S>(rotations), Vector<S>(last.linear.size())};
    for (Index j = 0; j < columns; ++j)
      (j < rotations ? component.angular[j] : component.linear[j - rotations]) =
          rounded_to<S>(raw(coefficients[static_cast<std::size_t>(j)]));
    result.push_back(std::move(component));
  }
  // An angular momentum about another point reads L_z + ... P, but linear momenta come first.
  std::stable_partition(result.begin(), result.end(), [](const auto& c) { return c.is_linear(); });
  return result;
}

#define HBVM_DEFINE(S)                                                                                    \
  template struct MomentumComponent<S>;                                                                   \
  template std::vector<MomentumComponent<S>> coordinate_momenta<S>(const Problem<S>&);                    \
  template MomentumValue<S> momentum<S>(const Problem<S>&, const MomentumComponent<S>&, const Vector<S>&, \
                                        const Vector<S>&);                                                \
  template std::vector<MomentumComponent<S>> conserved_momenta<S>(const Problem<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

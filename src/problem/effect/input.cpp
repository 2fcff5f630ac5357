#include "problem/effect/input.hpp"

#include <cmath>
#include <optional>

#include "hbvm/error.hpp"
#include "problem/effect/compile.hpp"

namespace hbvm::core {
namespace {

/// x if it is a whole number of moderate size.
template <Scalar S>
std::optional<long> whole(const S& x) {
  using std::floor;
  constexpr long limit = 1'000'000;
  if (!(x > -limit && x < limit) || floor(x) != x) return std::nullopt;
  return static_cast<long>(x);
}

/// floor(x), or a large number of its sign.
template <Scalar S>
long floor_of(const S& x) {
  using std::floor;
  constexpr long limit = 1'000'000;
  if (!(x > -limit)) return -limit;
  return x < limit ? static_cast<long>(S(floor(x))) : limit;
}

/// In the order in which make_term numbers them.
template <Scalar S>
std::vector<S> parameters_of(const EffectInput<S>& input, const typename EffectInput<S>::Instance& instance) {
  std::vector<S> p;
  for (Index i = 0; i < instance.mass_matrix.rows(); ++i)
    for (Index j = 0; j < instance.mass_matrix.cols(); ++j) p.push_back(instance.mass_matrix(i, j));
  p.insert(p.end(), std::begin(instance.masses), std::end(instance.masses));
  p.insert(p.end(), std::begin(instance.charges), std::end(instance.charges));
  for (const auto& [key, value] : input.numbers) p.push_back(value);
  for (const auto& [key, values] : input.vectors) p.insert(p.end(), values.begin(), values.end());
  return p;
}

/// v over its largest entry, so that products of its entries cannot leave the range of the numbers.
template <Scalar S>
Matrix<S> scaled(const Matrix<S>& v) {
  const S size = max_norm(v);
  return size == 0 ? v : Matrix<S>(v / size);
}

/// The axis of an instance, n = a or M a, and a bound of its round-off.
template <Scalar S>
void find_axis(const EffectInput<S>& input, const EffectAxis& axis, Index instance, EffectSymmetry<S>& result) {
  const Index d = input.dimension;
  const std::vector<S>& entries = input.vectors.find(axis.key)->second;
  Matrix<S> a(d, 1);
  for (Index j = 0; j < d; ++j) a(j, 0) = entries[static_cast<std::size_t>(j)];
  a = scaled(a);
  Matrix<S> M = Matrix<S>::Identity(d, d);
  if (axis.times_mass) M = scaled(input.instances[static_cast<std::size_t>(instance)].mass_matrix);
  for (Index j = 0; j < d; ++j) {
    S sum = 0, size = 0;
    for (Index l = 0; l < d; ++l) {
      const S term = M(j, l) * a(l, 0);
      sum += term;
      size += magnitude(term);
    }
    result.axes(instance, j) = sum;
    result.axis_round_off(instance, j) = S(2 * static_cast<int>(d)) * epsilon<S>() * size;
  }
}

template <class Effect, Scalar S>
EffectSymmetry<S> symmetry_of(const EffectInput<S>& input) {
  EffectSymmetry<S> result;
  result.kind = Effect::symmetry;
  bool all_act = true;
  for (const std::string_view key : Effect::factors) all_act = all_act && input.numbers.find(key)->second != 0;
  for (const auto& instance : input.instances)
    result.acts.push_back(all_act && !(Effect::needs_charge && (instance.charges[0] == 0 || instance.charges[1] == 0)));
  if constexpr (Effect::symmetry != Symmetry::central) {
    const auto count = static_cast<Index>(input.instances.size());
    result.axes = result.axis_round_off = Matrix<S>(count, input.dimension);
    for (Index n = 0; n < count; ++n) find_axis(input, Effect::axis, n, result);
  }
  return result;
}

}  // namespace

template <Scalar S>
EffectTerm<S> make_term(const EffectInput<S>& input) {
  Trace<S> trace;
  const auto d = static_cast<std::size_t>(input.dimension);
  Interaction<Traced<S>> formal;
  for (std::size_t j = 0; j < d; ++j) formal.x.emplace_back(trace, trace.input(j));
  std::size_t index = 0;
  const auto parameter = [&] { return Traced<S>(trace, trace.parameter(index++)); };
  for (std::size_t i = 0; i < d * d; ++i) formal.mass_matrix.push_back(parameter());
  for (int i = 0; i < 2; ++i) formal.masses.push_back(parameter());
  for (int i = 0; i < 2; ++i) formal.charges.push_back(parameter());
  // The keys' values are parameters, too. The code depends on them only where the formula asks for whole numbers, and
  // on the zeros of vectors. So one compiled kernel serves all values.
  for (const auto& [key, value] : input.numbers) {
    formal.numbers.emplace(key, parameter());
    if (const auto n = whole(value)) formal.whole_numbers.emplace(key, *n);
    formal.floors.emplace(key, floor_of(value));
  }
  for (const auto& [key, values] : input.vectors) {
    for (const S& value : values) {
      const Traced<S> entry = parameter();
      formal.vectors[key].push_back(value == 0 ? Traced<S>(trace, trace.constant(value)) : entry);
    }
  }

  std::optional<typename Trace<S>::Id> U;
  EffectTerm<S> term;
  with_effect(input.kind, [&]<class Effect>() {
    U = Effect::U(formal).id();
    term.symmetry = symmetry_of<Effect>(input);
  });
  if (!U) throw Error("no effect of kind '" + input.kind + "'");  // the scene reader has checked

  std::vector<std::vector<S>> parameters;
  for (const auto& instance : input.instances) {
    term.displacements.push_back(instance.x);
    parameters.push_back(parameters_of(input, instance));
  }
  term.kind = input.kind;
  compile(trace, *U, d, index, parameters, term);
  return term;
}

#define HBVM_DEFINE(S) template EffectTerm<S> make_term<S>(const EffectInput<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

#include "problem/effect/discrete_gradient.hpp"

#include <functional>

#include "printing.hpp"
#include "problem/effect/execution.hpp"
#include "problem/effect/input.hpp"
#include "scalar/literal.hpp"
#include "scalar/random_values.hpp"

namespace hbvm::core {
namespace {

template <class S>
class DiscreteGradients : public InDigits<50> {
 protected:
  static constexpr Index d = 3;
  RandomValues<S> random{2718};

  static EffectTerm<S> term(const char* kind, const std::vector<std::pair<const char*, const char*>>& numbers,
                            const char* vector = nullptr) {
    EffectInput<S> input{kind, d, {}, {}, {{}}};
    for (const auto& [key, text] : numbers) input.numbers[key] = literal<S>(text);
    if (vector) input.vectors[vector] = {S(1), S(-2), S(S(1) / 3)};
    input.instances[0].x = {{{0, S(1)}}, {}};
    input.instances[0].mass_matrix = Matrix<S>::Identity(d, d) * S(3);
    input.instances[0].masses[0] = 3;
    input.instances[0].masses[1] = 5;
    input.instances[0].charges[0] = 2;
    input.instances[0].charges[1] = -7;
    return make_term(input);
  }
  static std::vector<EffectTerm<S>> all() {
    return {term("central_gravity", {{"strength", "3/7"}}),
            term("coulomb", {{"strength", "2"}}),
            term("radial_cosine", {{"strength", "1/3"}}),
            term("trap", {{"stiffness", "4"}, {"exponent", "4"}}),
            term("lennard_jones", {{"depth", "1/5"}, {"diameter", "6/5"}}),
            term("spring", {{"stiffness", "3"}, {"rest_length", "7/2"}, {"exponent", "2"}}),
            term("spring", {{"stiffness", "3"}, {"rest_length", "2"}, {"exponent", "3"}}),
            term("spring", {{"stiffness", "3"}, {"rest_length", "1/5"}, {"exponent", "5/2"}}),
            term("oblateness", {{"strength", "2"}, {"radius", "1"}, {"J2", "1/9"}}, "axis"),
            term("uniform_gravity", {}, "acceleration")};
  }

  static Vector<S> run(const Program<S>& program, const Matrix<S>& coefficients, const std::vector<Vector<S>>& x) {
    Matrix<S> inputs(1, static_cast<Index>(x.size()) * d);
    for (std::size_t i = 0; i < x.size(); ++i)
      for (Index j = 0; j < d; ++j) inputs(0, static_cast<Index>(i) * d + j) = x[i][j];
    Execution<S> execution(program, coefficients, inputs, 1);
    execution.run();
    Vector<S> outputs(static_cast<Index>(program.outputs()));
    for (Index i = 0; i < outputs.size(); ++i) outputs[i] = execution.output(i, 0);
    return outputs;
  }
  static Vector<S> discrete(const EffectTerm<S>& term, const Vector<S>& x0, const Vector<S>& x1) {
    const DiscreteGradient<S> of = discrete_gradient(term, d);
    return run(of.program, of.coefficients, {x0, x1});
  }
  static S U(const EffectTerm<S>& term, const Vector<S>& x) { return run(term.value, term.value_coefficients, {x})[0]; }
  static Vector<S> gradient(const EffectTerm<S>& term, const Vector<S>& x) {
    return run(term.gradient, term.gradient_coefficients, {x});
  }
  static S inner(const Vector<S>& a, const Vector<S>& b) {
    S sum = 0;
    for (Index j = 0; j < d; ++j) sum += a[j] * b[j];
    return sum;
  }
  Vector<S> somewhere() {
    Vector<S> x = random.vector(d);
    x[0] += S(2);
    return x;
  }
};
TYPED_TEST_SUITE(DiscreteGradients, AllScalars, ScalarNames);

TYPED_TEST(DiscreteGradients, TimesTheDifferenceAreThatOfU) {
  using S = TypeParam;
  for (const EffectTerm<S>& term : this->all())
    for (int n = 0; n < 5; ++n) {
      const Vector<S> x0 = this->somewhere(), x1 = this->somewhere(), D = this->discrete(term, x0, x1);
      const S U0 = this->U(term, x0), U1 = this->U(term, x1);
      const S size = magnitude(U0) + magnitude(U1) + max_norm(D);
      EXPECT_LE(magnitude(S(this->inner(D, Vector<S>(x1 - x0)) - (U1 - U0))), 64 * size * epsilon<S>()) << term.kind;
    }
}

TYPED_TEST(DiscreteGradients, AreTheGradientWhereTheyMeetAndSymmetric) {
  using S = TypeParam;
  for (const EffectTerm<S>& term : this->all()) {
    const Vector<S> x0 = this->somewhere(), x1 = this->somewhere();
    const Vector<S> there = this->discrete(term, x0, x1), back = this->discrete(term, x1, x0),
                    at = this->gradient(term, x0);
    EXPECT_LE(max_norm(Vector<S>(there - back)), 64 * epsilon<S>() * max_norm(there)) << term.kind;
    EXPECT_LE(max_norm(Vector<S>(this->discrete(term, x0, x0) - at)), 64 * epsilon<S>() * max_norm(at)) << term.kind;
  }
}

/// Half of the digits of the points agree, and all of those of the forces are right. To second order they are those of
/// the middle.
TYPED_TEST(DiscreteGradients, LoseNoDigitsBetweenNeighbours) {
  using S = TypeParam;
  using std::sqrt;
  const S small = sqrt(epsilon<S>());
  for (const EffectTerm<S>& term : this->all()) {
    const Vector<S> x0 = this->somewhere(), x1 = x0 + small * this->random.vector(3),
                    at = this->gradient(term, Vector<S>((x0 + x1) / 2));
    EXPECT_LE(max_norm(Vector<S>(this->discrete(term, x0, x1) - at)), 256 * epsilon<S>() * max_norm(at)) << term.kind;
  }
}

/// Of second order, so not the gradient of the middle itself.
TYPED_TEST(DiscreteGradients, AreOfSecondOrder) {
  using S = TypeParam;
  const Vector<S> x0 = this->somewhere(), v = this->random.vector(3);
  for (const EffectTerm<S>& term : this->all()) {
    if (term.degree == 1) continue;
    const auto error = [&](long n) {
      const Vector<S> x1 = x0 + v / S(n);
      return max_norm(Vector<S>(this->discrete(term, x0, x1) - this->gradient(term, Vector<S>((x0 + x1) / 2))));
    };
    const double ratio = approximately(S(error(64) / error(128)));
    EXPECT_GT(ratio, 3.7) << term.kind;
    EXPECT_LT(ratio, 4.3) << term.kind;
  }
}

/// Central ones pull along the mean displacement, axial ones in the plane of that and the axis.
TYPED_TEST(DiscreteGradients, KeepWhatRotationsKeep) {
  using S = TypeParam;
  for (const EffectTerm<S>& term : this->all()) {
    const Vector<S> x0 = this->somewhere(), x1 = this->somewhere(), D = this->discrete(term, x0, x1),
                    mean = (x0 + x1) / 2;
    Vector<S> torque(3);
    for (Index j = 0; j < 3; ++j) torque[j] = mean[(j + 1) % 3] * D[(j + 2) % 3] - mean[(j + 2) % 3] * D[(j + 1) % 3];
    S kept = max_norm(torque);
    if (term.symmetry.kind != Symmetry::central) {
      kept = 0;
      for (Index j = 0; j < 3; ++j) kept += torque[j] * term.symmetry.axes(0, j);
      EXPECT_GT(max_norm(torque), 64 * epsilon<S>() * max_norm(D)) << term.kind;
    }
    EXPECT_LE(magnitude(kept), 64 * epsilon<S>() * max_norm(D) * max_norm(mean)) << term.kind;
  }
}

/// Each operation by itself, at points apart, side by side, and on both sides of 0 where it is defined there.
TYPED_TEST(DiscreteGradients, HaveTheQuotientOfEveryOperation) {
  using S = TypeParam;
  using std::atan, std::cos, std::cosh, std::exp, std::log, std::sin, std::sinh, std::sqrt, std::tanh;
  const std::pair<Op, std::function<S(const S&)>> functions[] = {
      {Op::negate, [](const S& x) { return S(-x); }},        {Op::abs, [](const S& x) { return magnitude(x); }},
      {Op::reciprocal, [](const S& x) { return S(1 / x); }}, {Op::sqrt, [](const S& x) { return S(sqrt(x)); }},
      {Op::sin, [](const S& x) { return S(sin(x)); }},       {Op::cos, [](const S& x) { return S(cos(x)); }},
      {Op::exp, [](const S& x) { return S(exp(x)); }},       {Op::log, [](const S& x) { return S(log(x)); }},
      {Op::sinh, [](const S& x) { return S(sinh(x)); }},     {Op::cosh, [](const S& x) { return S(cosh(x)); }},
      {Op::tanh, [](const S& x) { return S(tanh(x)); }},     {Op::atan, [](const S& x) { return S(atan(x)); }}};
  for (const auto& [op, f] : functions) {
    EffectTerm<S> term;
    term.value = Program<S>({}, {{op, {Bank::input, 0}, {}, 0}}, {{Bank::temporary, 0}}, 1);
    term.value_coefficients.resize(1, 0);
    std::vector<std::pair<S, S>> points{{S(1) / 3, S(7) / 4}, {S(5), S(6)}};
    if (op != Op::sqrt && op != Op::log) points.push_back({S(-2), S(S(1) / 7)});
    if (op == Op::atan) points.push_back({S(-5), S(7)});  // whose angles are more than a right one apart
    for (const auto& [x0, x1] : points) {
      Vector<S> first = Vector<S>::Zero(3), second = first;
      first[0] = x0;
      second[0] = x1;
      const Vector<S> D = this->discrete(term, first, second);
      EXPECT_LE(magnitude(S(D[0] - (f(x1) - f(x0)) / (x1 - x0))), 32 * epsilon<S>() * (1 + magnitude(f(x1))))
          << name_of(op);
      EXPECT_EQ(D[1], 0);
    }
  }
}

TEST(DiscreteGradient, OfASignIsRefused) {
  EffectTerm<double> term;
  term.value = Program<double>({}, {{Op::sign, {Bank::input, 0}, {}, 0}}, {{Bank::temporary, 0}}, 1);
  term.value_coefficients.resize(1, 0);
  EXPECT_THROW(discrete_gradient(term, 2), Error);
}

}  // namespace
}  // namespace hbvm::core

// "A new effect" of src/README.md, with its two lines: compiled in place of the library's own list of effects.
#include <gtest/gtest.h>

#include "problem/effect/input.hpp"
#include "problem/potential.hpp"

namespace hbvm::core {
namespace {

/// The force is that of its formula: differences of U with 60 digits, where that of a pair is -strength Q Q
/// exp(-r/l)/r.
TEST(Recipe, GivesTheForceOfItsFormula) {
  const PrecisionScope digits(60);
  EffectInput<Mpfr> input;
  input.kind = "yukawa";
  input.dimension = 2;
  input.numbers = {{"strength", Mpfr(3) / 8}, {"length", Mpfr(5) / 4}};
  input.instances.resize(1);
  input.instances[0].x.blocks = {{0, Mpfr(1)}};
  input.instances[0].mass_matrix = Matrix<Mpfr>::Identity(2, 2);  // of no use to a pair
  input.instances[0].charges[0] = Mpfr(7) / 4;
  input.instances[0].charges[1] = -Mpfr(1) / 2;
  Potential<Mpfr> potential;
  potential.dimension = 2;
  potential.m = 2;
  potential.terms = {make_term(input)};
  PotentialEvaluator<Mpfr> evaluator(potential, 1);
  const Mpfr QQ = input.instances[0].charges[0] * input.instances[0].charges[1];
  const auto U = [&](const Vector<Mpfr>& q) {
    const Mpfr r = sqrt(Mpfr(q[0] * q[0] + q[1] * q[1]));
    return Mpfr(-input.numbers["strength"] * QQ * exp(Mpfr(-r / input.numbers["length"])) / r);
  };
  Vector<Mpfr> q(2), value(1);
  q << Mpfr(3) / 4, Mpfr(-5) / 8;
  Matrix<Mpfr> force;
  evaluator.force(lanes(q), force);
  evaluator.values(lanes(q), value);
  EXPECT_LE(magnitude(Mpfr(value[0] - U(q))), 16 * epsilon<Mpfr>());
  const Mpfr h = ldexp(Mpfr(1), -60);
  for (Index j = 0; j < 2; ++j) {
    Vector<Mpfr> up = q, down = q;
    up[j] += h;
    down[j] -= h;
    EXPECT_LE(magnitude(Mpfr(force(0, j) - (U(up) - U(down)) / (2 * h))), 4 * h * h);
  }
}

}  // namespace
}  // namespace hbvm::core

#pragma once

#include <array>
#include <numeric>
#include <utility>

#include "problem/constraint/body_joint.hpp"
#include "problem/constraint/formula_constraint.hpp"
#include "problem/effect/compile.hpp"

namespace hbvm::core {

/// Two wheels that turn about axes fixed in space by angles with a x + b y = 0. Their teeth a : b are whole numbers
/// without a common divisor. A direction of each across its axis is a complex number, z and w, whose angles are x and
/// y. So g = Im(z^a w^b) is a polynomial of degree a + |b|; for negative b it has the conjugate of w. Its derivatives
/// by the angles are a and b where it is 0.
template <Scalar S>
struct Gear {
  static constexpr std::string_view kind = "gear";
  static constexpr std::array<ConstraintKey, 5> keys{{{"between", ConstraintKey::Takes::pair},
                                                      {"first_teeth", ConstraintKey::Takes::number},
                                                      {"second_teeth", ConstraintKey::Takes::number},
                                                      {"axis", ConstraintKey::Takes::vector, true},
                                                      {"second_axis", ConstraintKey::Takes::vector, true}}};

  static FormulaConstraint<S> from(const ConstraintInput<S>& input) {
    const auto& [first, second] = input.frames.find("between")->second;
    for (const Frame<S>* const frame : {&first, &second})
      if (frame->of != Frame<S>::Of::rigid_body) throw InputError("a gear is of points of two rigid bodies");
    int a = teeth(input, "first_teeth"), b = teeth(input, "second_teeth");
    const int common = std::gcd(a, b);
    a /= common, b /= common;
    if (a < 0) a = -a, b = -b;  // the same turning
    constexpr int most = 100;
    if (a + std::abs(b) > most)
      throw InputError("its teeth without a common divisor, " + std::to_string(a) + " and " + std::to_string(b) +
                       ", make a polynomial of a degree beyond " + std::to_string(most) + "; take a simpler ratio");

    const Index d = input.dimension;
    if (d == 3 && !input.has_vector("axis")) throw InputError("'axis' is missing; in space wheels turn about axes");
    if (d == 2 && (input.has_vector("axis") || input.has_vector("second_axis")))
      throw InputError("in the plane wheels need no axis");
    FormulaConstraint<S> result;
    EffectTerm<S>& term = result.term;
    term.kind = "gear";
    term.arguments = 2;
    Trace<S> trace;
    const auto z = power(direction(trace, term, input, first, "axis"), a);
    auto w = direction(trace, term, input, second, input.has_vector("second_axis") ? "second_axis" : "axis");
    if (b < 0) w.second = -w.second;
    w = power(w, std::abs(b));
    compile(trace, product(z, w).second.id(), static_cast<std::size_t>(2 * d), 0, {{}}, term);
    // No rotation of space keeps it, and every translation does.
    const Index rotations = d == 2 ? 1 : 3;
    term.symmetry.kind = Symmetry::computed;
    term.symmetry.conditions = Matrix<S>::Identity(rotations, rotations + d);
    return result;
  }

 private:
  using Complex = std::pair<Traced<S>, Traced<S>>;

  static int teeth(const ConstraintInput<S>& input, const char* key) {
    const S& number = input.number(key);
    const double value = approximately(number);
    constexpr int most = 1'000'000;
    if (!(value >= -most && value <= most) || S(static_cast<int>(value)) != number || value == 0)
      throw InputError(std::string("'") + key + "' must be a whole number and not 0, negative for teeth inside");
    return static_cast<int>(value);
  }

  /// The direction e across the axis of a wheel, as a complex number: along e at the start, and along n x e there.
  static Complex direction(Trace<S>& trace, EffectTerm<S>& term, const ConstraintInput<S>& input, const Frame<S>& frame,
                           const char* key) {
    const Index d = input.dimension, from = d * static_cast<Index>(term.displacements.size());
    const std::vector<Vector<S>> plane = d == 2 ? std::vector<Vector<S>>{Vector<S>::Unit(2, 0), Vector<S>::Unit(2, 1)}
                                                : across(unit_axis(input.vector(key), key));
    term.displacements.push_back(frame.direction(plane[0]));
    const Matrix<S> start = BodyJoint<S>::orthonormal(frame);
    const auto along = [&](const Vector<S>& v) {
      const Vector<S> in_space = start.transpose() * v;
      const auto product = [&](Index i) {
        return Traced<S>(trace, trace.constant(in_space[i])) *
               Traced<S>(trace, trace.input(static_cast<std::size_t>(from + i)));
      };
      Traced<S> sum = product(0);
      for (Index i = 1; i < d; ++i) sum = sum + product(i);
      return sum;
    };
    return {along(plane[0]), along(plane[1])};
  }

  static Complex product(const Complex& z, const Complex& w) {
    const Traced<S> squares = z.second * w.second;
    const Traced<S> real = z.first * w.first - squares;
    const Traced<S> crossed = z.second * w.first;
    return {real, z.first * w.second + crossed};
  }

  static Complex power(const Complex& z, int exponent) {
    Complex result = z;
    for (int i = 1; i < exponent; ++i) result = product(result, z);
    return result;
  }
};

}  // namespace hbvm::core

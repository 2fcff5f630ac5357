#pragma once

#include <gtest/gtest.h>

#include <random>

#include "printing.hpp"
#include "problem/state_evaluator.hpp"
#include "reference/closed_form/closed_form.hpp"
#include "reference/scene_tables.hpp"
#include "reference/taylor.hpp"

namespace hbvm::core {

/// "a/b" between -2 and 2, and between 1/4 and 4, of small numbers.
class Fractions {
 public:
  explicit Fractions(unsigned seed) : generator_(seed) {}
  std::string any() {
    const int below = 7 + static_cast<int>(generator_() % 90);
    return std::to_string(static_cast<int>(generator_() % static_cast<unsigned>(4 * below + 1)) - 2 * below) + "/" +
           std::to_string(below);
  }
  std::string positive() {
    return std::to_string(10 + generator_() % 70) + "/" + std::to_string(20 + generator_() % 40);
  }
  /// ["a/b", ...]
  std::string vector(int entries) {
    std::string text = "[";
    for (int i = 0; i < entries; ++i) text += (i > 0 ? ", \"" : "\"") + any() + "\"";
    return text + "]";
  }

 private:
  std::mt19937 generator_;
};

/// A body at a distance that is no number of few digits: pivot + r, r and v in expressions, v across r.
inline std::string pendulum_scene(Fractions& random, int dimension, const std::string& velocity_scale,
                                  const std::string& gravity) {
  std::string constants, position = "[", velocity = "[", pivot = "[";
  const char* const axes[] = {"x", "y", "z"};
  std::string square, product;
  for (int i = 0; i < dimension; ++i) {
    const std::string a = axes[i];
    constants += "r" + a + " = \"" + random.any() + "\"\nw" + a + " = \"" + random.any() + "\"\n";
    constants += "c" + a + " = \"" + random.any() + "\"\n";
    const std::string comma = i > 0 ? ", " : "";
    square += (i > 0 ? " + " : "") + ("r" + a + "^2");
    product += (i > 0 ? " + " : "") + ("r" + a + "*w" + a);
    pivot += comma + "\"c" + a + "\"";
    position += comma + "\"c" + a + " + r" + a + "\"";
    velocity += comma + "\"(w" + a + " - along*r" + a + ")*(" + velocity_scale + ")\"";
  }
  constants += "square = \"" + square + "\"\nalong = \"(" + product + ")/square\"\n";
  return "dimension = " + std::to_string(dimension) + "\n[constants]\n" + constants + point("pivot", pivot + "]") +
         body("bob", "\"" + random.positive() + "\"", position + "]", velocity + "]") +
         rod("pivot", "bob", "\"sqrt(square)\"") + field(gravity);
}

/// The scene has a closed form of this name. That is where the Taylor series are at these times, but for what rounding
/// leaves: `lost` digits.
inline void expect_follows_taylor(const std::string& toml, const std::string& name,
                                  const std::vector<const char*>& times, unsigned digits = 40, int lost = 8) {
  const PrecisionScope scope(digits);
  const Assembled<Mpfr> scene = assemble<Mpfr>(read_scene(toml, "random"));
  const std::unique_ptr<ClosedForm> motion = closed_form_of(scene);
  ASSERT_TRUE(motion) << toml;
  EXPECT_EQ(motion->name().substr(0, name.size()), name) << toml;
  TaylorMotion taylor(scene.problem, scene.q0, scene.p0);
  const Mpfr tolerance = epsilon<Mpfr>() * pow(Mpfr(10), lost);
  for (const char* time : times) {
    const Mpfr t = literal<Mpfr>(time);
    taylor.advance_to(t);
    const ExactPoint exact = motion->at(t);
    const auto compare = [&](const char* what, const Vector<Mpfr>& expected, const Vector<Mpfr>& found) {
      EXPECT_LE(distance(expected, found), tolerance * (1 + max_norm(expected))) << what << " at " << time << "\n"
                                                                                 << toml;
    };
    compare("q", exact.q, taylor.q());
    compare("p", exact.p, taylor.p());
    if (scene.problem.nu() > 0) compare("lambda", exact.lambda, taylor.lambda());
  }
}

/// The motion starts where the scene does, keeps its energy and constraints to `digits`, and fulfils its equations by
/// differences.
inline void expect_solves_equations(const std::string& toml, const std::vector<const char*>& times, unsigned digits) {
  const PrecisionScope scope(digits);
  const Assembled<Mpfr> scene = assemble<Mpfr>(read_scene(toml, "random"));
  const std::unique_ptr<ClosedForm> motion = closed_form_of(scene);
  ASSERT_TRUE(motion) << toml;
  StateEvaluator<Mpfr> point(scene.problem);
  const Mpfr few = 10'000 * epsilon<Mpfr>(), H = point.energy(scene.q0, scene.p0);
  const ExactPoint start = motion->at(Mpfr(0));
  EXPECT_LE(distance(start.q, scene.q0), few);
  EXPECT_LE(distance(start.p, scene.p0), few);
  // Differences err by the square of the step and by rounding over the step.
  const Mpfr step = pow(Mpfr(10), -static_cast<int>(digits) / 3), rough = pow(Mpfr(10), 8) * step * step;
  for (const char* time : times) {
    const Mpfr t = literal<Mpfr>(time);
    const ExactPoint before = motion->at(t - step), now = motion->at(t), after = motion->at(t + step);
    EXPECT_LE(magnitude(Mpfr(point.energy(now.q, now.p) - H)), few * point.energy_size(now.q, now.p)) << time;
    if (scene.problem.nu() > 0) {
      EXPECT_LE(max_norm(point.constraints(now.q)), few * point.constraint_size(now.q)) << time;
      EXPECT_LE(max_norm(point.hidden_constraints(now.q, now.p)), few * 100) << time;
    }
    Vector<Mpfr> v(now.p.size());
    scene.problem.mass.velocity(lanes(std::as_const(now.p)), lanes(v));
    EXPECT_LE(distance(Vector<Mpfr>((after.q - before.q) / (2 * step)), v), rough) << time;
    const auto& forces = point.forces(now.q, now.p);
    EXPECT_LE(
        distance(Vector<Mpfr>((after.p - before.p) / (2 * step)), Vector<Mpfr>(forces.applied + forces.constraint)),
        rough)
        << time;
  }
}

/// A scene of which no closed form is known.
inline void expect_unknown(const std::string& toml) {
  const PrecisionScope scope(40);
  const Assembled<Mpfr> scene = assemble<Mpfr>(read_scene(toml, "near miss"));
  const std::unique_ptr<ClosedForm> motion = closed_form_of(scene);
  EXPECT_FALSE(motion) << toml << (motion ? motion->name() : "");
}

}  // namespace hbvm::core

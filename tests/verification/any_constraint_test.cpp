// Constraints that are not quadratic, against motions in closed form and against quadratic ones that say the same.

#include "printing.hpp"
#include "problem/state_evaluator.hpp"
#include "reference/known_motion.hpp"
#include "reference/request_of.hpp"
#include "scene/scene_text.hpp"
#include "step/hbvm_method.hpp"
#include "step/stepping.hpp"

namespace hbvm::core {
namespace {

std::string text_of(const std::string& name) {
  for (const auto& [known, text] : built_in_scenes())
    if (known == name) return text;
  throw InputError("no scene " + name);
}

TEST(AnyConstraint, HasTheDigitsOfItsClosedForm) {
  for (const char* scene : {"bead_on_helix", "bead_on_cycloid"}) {
    const Reference reference = compute_reference(request_of(scene, {"1/2", "3", "10"}, 50));
    EXPECT_EQ(reference.routes.size(), 2u);
    const PrecisionScope scope(120);
    for (const ReferenceState& state : reference.times) {
      EXPECT_GT(state.agreed, 50);
      const Vector<Mpfr> exact = known_motion(scene, literal<Mpfr>(state.t)).q;
      for (std::size_t j = 0; j < state.q.size(); ++j)
        EXPECT_LE(magnitude(Mpfr(literal<Mpfr>(state.q[j]) - exact[static_cast<Index>(j)])),
                  max_norm(exact) * literal<Mpfr>("5.1e-51"))
            << scene << " t = " << state.t << ' ' << j;
    }
  }
}

/// After pi sqrt(17), the same for all amplitudes.
TEST(AnyConstraint, CycloidIsIsochronous) {
  for (const auto& [v_x, v_z] : {std::pair("1", "1/4"), {"1/100", "1/400"}, {"9/5", "9/20"}}) {
    const std::string text = changed(text_of("bead_on_cycloid"), "velocity = [1, 0, \"1/4\"]",
                                     std::string("velocity = [\"") + v_x + "\", 0, \"" + v_z + "\"]");
    // After the period q is 0, and its digits are those of what it was before.
    const Reference reference = compute_reference(request_of(read_scene(text, "cycloid"), {"1", "pi*sqrt(17)"}, 40));
    const PrecisionScope scope(60);
    const Mpfr size = literal<Mpfr>(v_x);
    for (const std::string& q : reference.times[1].q)
      EXPECT_LE(magnitude(literal<Mpfr>(q)), literal<Mpfr>("1e-38")) << v_x;
    EXPECT_LE(magnitude(Mpfr(literal<Mpfr>(reference.times[1].p[0]) - size)), size * literal<Mpfr>("1e-38"));
  }
}

/// Position and output state at t = 1, after n steps.
struct End {
  Vector<Mpfr> q, p;
  Mpfr e_g = 0;
};
End end_of(const Assembled<Mpfr>& scene, const MethodPtr& method, int n) {
  const auto stepper = method->make_stepper(scene.problem, SolverKind::automatic);
  State<Mpfr> state(scene.q0, scene.p0);
  StateEvaluator<Mpfr> point(scene.problem);
  End end;
  for (int i = 0; i < n; ++i) {
    stepper->step(state, Mpfr(1) / n);
    raise_to(end.e_g, max_norm(point.constraints(state.q)));
  }
  end.q = state.q;
  end.p = point.tangential(state.q, state.p);
  return end;
}

/// Every method that takes constraints, at its order, g kept.
TEST(AnyConstraint, IsKeptByEveryMethodAtItsOrder) {
  const PrecisionScope scope(60);
  const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene("bead_on_helix"));
  const Vector<Mpfr> exact = known_motion("bead_on_helix", Mpfr(1)).q;
  for (const char* name : {"rattle", "lobatto:3", "compose:rattle,4", "projected_hbvm:3,3,20", "restored_hbvm:3,3,20",
                           "hbvm:2,2,20", "hbvm:3,3,20"}) {
    const MethodPtr method = parse_method(name);
    Mpfr error[2];
    for (const int i : {0, 1}) {
      const End end = end_of(scene, method, 16 << i);
      error[i] = distance(end.q, exact);
      EXPECT_LE(end.e_g, literal<Mpfr>("1e-40")) << name;
    }
    EXPECT_GT(order_of(error[0], error[1]), method->order() - 0.25) << name;
  }
}

TEST(AnyConstraint, IsRefusedWhereAFormulaNeedsQuadraticOnes) {
  const Assembled<double> scene = assemble<double>(load_scene("bead_on_torus"));
  EXPECT_THROW(parse_method("energy_momentum")->make_stepper(scene.problem, SolverKind::automatic), InputError);
}

/// The double pendulum with formulas for its rods.
std::string pendulum_by(const std::string& of_upper, const std::string& of_lower) {
  const auto formula = [](const std::string& bodies, const std::string& g) {
    return "{ kind = \"formula\", " + bodies + ", g = \"" + g + "\" }";
  };
  const std::string half =
      changed(text_of("double_pendulum"), "{ kind = \"rod\", between = [\"pivot\", \"a\"], length = 1 }",
              formula("of = [\"pivot\", \"a\"]", of_upper));
  return changed(half, "{ kind = \"rod\", between = [\"a\", \"b\"], length = 1.3 }",
                 formula("between = [\"a\", \"b\"]", of_lower));
}

/// The rods of the double pendulum by their squares are the rods: but for one rounding of 1.3^2, the same digits.
TEST(AnyConstraint, OfDegree2IsTheQuadraticOne) {
  const std::string upper = "(a.x - pivot.x)^2 + (a.y - pivot.y)^2 - 1", lower = "x^2 + y^2 - 1.3^2";
  for (const unsigned digits : {20U, 50U}) {
    const PrecisionScope scope(digits);
    const auto formulas = assemble<Mpfr>(read_scene(pendulum_by(upper, lower), "formulas")),
               rods = assemble<Mpfr>(load_scene("double_pendulum"));
    for (const auto& constraint : formulas.problem.constraints)
      EXPECT_TRUE(std::holds_alternative<Rod<Mpfr>>(constraint.form));
    const End a = end_of(formulas, parse_method("hbvm:4,3"), 16), b = end_of(rods, parse_method("hbvm:4,3"), 16);
    EXPECT_LE(distance(a.q, b.q), 256 * epsilon<Mpfr>());
    EXPECT_LE(distance(a.p, b.p), 256 * epsilon<Mpfr>());
  }
}

/// By their lengths they are general constraints and the same motion, of order 2s.
TEST(AnyConstraint, OfTheSameSurfaceIsTheSameMotion) {
  const PrecisionScope scope(50);
  const std::string upper = "sqrt((a.x - pivot.x)^2 + (a.y - pivot.y)^2) - 1", lower = "r - 1.3";
  const auto lengths = assemble<Mpfr>(read_scene(pendulum_by(upper, lower), "lengths")),
             rods = assemble<Mpfr>(load_scene("double_pendulum"));
  EXPECT_NE(degree(lengths.problem.constraints), 2);
  const End exact = end_of(rods, parse_method("hbvm:16,16"), 16);
  for (const int s : {1, 2, 3}) {
    const MethodPtr method = hbvm_of({s, s, s + 2});
    Mpfr error[2];
    for (const int i : {0, 1}) {
      const End end = end_of(lengths, method, 32 << i);
      error[i] = std::max(distance(end.q, exact.q), distance(end.p, exact.p));
    }
    EXPECT_GT(order_of(error[0], error[1]), 2 * s - 0.25) << s;
  }
}

}  // namespace
}  // namespace hbvm::core

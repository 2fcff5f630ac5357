#include "run/tangent_map.hpp"

#include <cmath>

#include "printing.hpp"
#include "scalar/log2_of.hpp"
#include "step/registry.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

RunRequest request_for(const std::string& scene, const std::string& method, const std::string& step,
                       const std::string& until, const std::string& precision = "double") {
  return {load_scene(scene),       parse_method(method),     SolverKind::automatic,
          Expression::parse(step), Expression::parse(until), Precision::parse(precision)};
}

TangentMap map_of(const RunRequest& request) { return tangent_map(request, {}); }

double digits(const Mpfr& x) { return -log2_of(x) / std::log2(double(10)); }

/// The end of a run from a start that is moved along a direction by so little, in many more digits.
Vector<Mpfr> moved_end(const RunRequest& request, const Vector<Mpfr>& direction, const Mpfr& by) {
  const Assembled<Mpfr> scene = assemble<Mpfr>(request.scene);
  const Index m = scene.problem.m();
  State<Mpfr> state(Vector<Mpfr>(scene.q0 + by * direction.head(m)), Vector<Mpfr>(scene.p0 + by * direction.tail(m)));
  const auto stepper = request.method->make_stepper<Mpfr>(scene.problem, SolverKind::newton);
  const TimeGrid<Mpfr> grid(request.step, request.until);
  for (long n = 0; n < grid.steps(); ++n) stepper->step(state, grid.step());
  Vector<Mpfr> end(2 * m);
  end << state.q, state.p;
  return end;
}

/// Against central differences in other digits, where no constraint bends the directions.
TEST(TangentMapTest, IsTheDerivativeOfTheSteps) {
  const RunRequest request = request_for("henon_heiles", "hbvm:3,3", "1/8", "4", "mpfr:50");
  const TangentMap map = map_of(request);
  ASSERT_EQ(map.start.cols(), 4);
  const PrecisionScope scope(300);
  const Mpfr by = pow(Mpfr(10), -60);
  for (Index j = 0; j < 4; ++j) {
    const Vector<Mpfr> direction = map.start.col(j);
    const Vector<Mpfr> difference =
        (moved_end(request, direction, by) - moved_end(request, direction, Mpfr(-by))) / (2 * by);
    EXPECT_GT(digits(Mpfr(max_norm(Vector<Mpfr>(difference - map.end.col(j))) / max_norm(difference))), 45);
  }
}

/// HBVM(s,s) and RATTLE keep the 2-form, and HBVM(2s,s) does not.
TEST(TangentMapTest, IsSymplecticWhereTheMethodIs) {
  for (const auto& [scene, method] : {std::pair("henon_heiles", "hbvm:2,2"), {"double_pendulum", "rattle"}}) {
    const PrecisionScope scope(60);
    EXPECT_GT(digits(map_of(request_for(scene, method, "1/16", "2")).symplectic_defect), 16) << scene;
  }
  const PrecisionScope scope(60);
  EXPECT_LT(digits(map_of(request_for("henon_heiles", "hbvm:4,2", "1/4", "4")).symplectic_defect), 12);
}

/// Exponents of a constrained motion: as many as its manifold has dimensions, in pairs.
TEST(TangentMapTest, HasExponentsInPairs) {
  const TangentMap map = map_of(request_for("chaotic_double_pendulum", "hbvm:4,4", "1/8", "200"));
  ASSERT_EQ(map.exponents.size(), 4u);
  const auto& e = map.exponents;
  EXPECT_GT(e[0].value, 0.1);
  EXPECT_NEAR(e[0].value + e[3].value, 0, e[0].uncertainty + e[3].uncertainty);
  EXPECT_NEAR(e[1].value + e[2].value, 0, e[1].uncertainty + e[2].uncertainty);
  EXPECT_NEAR(e[0].value + e[1].value + e[2].value + e[3].value, 0, 0.02);
  EXPECT_NEAR(map.growth.back() * std::log(10), e[0].value * 200, 30);
  EXPECT_EQ(map.times.back(), 200);
}

/// How the end of a fall changes with the constant of gravity.
TEST(TangentMapTest, KnowsSensitivitiesToConstants) {
  RunRequest request = request_for("kepler", "hbvm:2,2", "1/8", "2");
  request.scene = read_scene(
      "dimension = 2\nconstants = { g = \"3/2\" }\nbody = [{ name = \"a\", mass = 2, position = [0, 1], velocity = [1, "
      "0] "
      "}]\neffect = [{ kind = \"uniform_gravity\", acceleration = [0, \"-g\"] }]\n",
      "fall");
  const PrecisionScope scope(60);
  const Vector<Mpfr> change = constant_sensitivity(request, "g");
  EXPECT_LE(magnitude(Mpfr(change[1] + 2)), pow(Mpfr(10), -15));  // -t^2/2
  EXPECT_LE(magnitude(Mpfr(change[3] + 4)), pow(Mpfr(10), -15));  // -m t
  EXPECT_EQ(change[0], 0);
  expect_words(message_of<InputError>([&] { constant_sensitivity(request, "h"); }), {"no constant 'h'"});
}

TEST(TangentMapTest, RefusesWhatItIsNotFor) {
  expect_words(message_of<InputError>([] { map_of(request_for("kepler", "verlet", "1/8", "1")); }), {"ten steps"});
  expect_words(message_of<InputError>([] { map_of(request_for("driven_pendulum", "hbvm:2,2", "1/8", "4")); }),
               {"potential"});
}

}  // namespace
}  // namespace hbvm::core

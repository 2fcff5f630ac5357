#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "door/door.hpp"
#include "hbvm/error.hpp"
#include "hbvm/solver.hpp"
#include "scene/assemble.hpp"
#include "words.hpp"

namespace hbvm {
namespace {

using Vector2 = Eigen::Vector2d;

/// Kepler's problem by somebody's own code, as CSV.
struct OwnKepler {
  std::string method;
  bool with_velocities = true;

  static Vector2 pull(const Vector2& q) { return -q / std::pow(q.norm(), 3); }

  static void verlet(Vector2& q, Vector2& v, double h) {
    v += h / 2 * pull(q);
    q += h * v;
    v += h / 2 * pull(q);
  }
  static void rk4(Vector2& q, Vector2& v, double h) {
    const Vector2 v1 = v, a1 = pull(q), v2 = v + h / 2 * a1, a2 = pull(q + h / 2 * v1), v3 = v + h / 2 * a2,
                  a3 = pull(q + h / 2 * v2), v4 = v + h * a3, a4 = pull(q + h * v3);
    q += h / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
    v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }

  std::string operator()(const SolverTask& task) const {
    const auto start = core::assemble<double>(core::scene_of(task.scene), core::Consistency::unchecked);
    Vector2 q = start.q0, v = start.p0;
    const double h = std::strtod(task.step.c_str(), nullptr), until = std::strtod(task.until.c_str(), nullptr);
    const long steps = std::lround(until / h);
    std::string csv = with_velocities ? "t,planet.x,planet.y,planet.vx,planet.vy\n" : "t,planet.x,planet.y\n";
    for (long n = 0; n <= steps; ++n) {
      csv += fmt::format("{},{},{}", static_cast<double>(n) * h, q[0], q[1]);
      if (with_velocities) csv += fmt::format(",{},{}", v[0], v[1]);
      csv += "\n";
      if (method == "verlet")
        verlet(q, v, h);
      else
        rk4(q, v, h);
    }
    return csv;
  }
};

SolverAudit kepler_audit(const OwnKepler& own, std::optional<int> order) {
  SolverRequest request{.name = own.method, .solve = own, .order = order, .scenes = {load_scene("kepler")}};
  request.until = Number(4);
  return audit_solver(request);
}

TEST(DoorSolvers, SeeOrderDriftAndReversalOfVerlet) {
  const SolverAudit audit = kepler_audit({"verlet"}, 2);
  EXPECT_TRUE(audit.holds);
  EXPECT_TRUE(audit.decided);
  ASSERT_EQ(audit.verdicts.size(), 3u);
  EXPECT_EQ(audit.verdicts[0].verdict, "holds");
  EXPECT_NEAR(*audit.verdicts[0].measured, 2, 0.1);
  core::expect_words(audit.verdicts[1].reason, {"stays bounded"});
  core::expect_words(audit.verdicts[2].reason, {"symmetric: it comes back"});
  EXPECT_GT(*audit.verdicts[2].measured, 12);
}

TEST(DoorSolvers, SeeOrderDriftAndReversalOfRungeKutta) {
  const SolverAudit audit = kepler_audit({"rk4"}, {});
  EXPECT_TRUE(audit.holds);
  EXPECT_EQ(audit.verdicts[0].verdict, "seen");
  EXPECT_NEAR(*audit.verdicts[0].measured, 4, 0.2);
  core::expect_words(audit.verdicts[1].reason, {"grows as t^"});
  core::expect_words(audit.verdicts[2].reason, {"not symmetric"});
  core::expect_words(to_text(audit), {"kepler\n", "order: seen, ", "reversal: seen", "holds"});
}

TEST(DoorSolvers, FailAnOrderThatIsNotThere) {
  const SolverAudit audit = kepler_audit({"verlet"}, 4);
  EXPECT_FALSE(audit.holds);
  EXPECT_EQ(audit.verdicts[0].verdict, "fails");
  const auto json = nlohmann::json::parse(to_json(audit));
  EXPECT_EQ(json["verdicts"][0]["claimed"], 4);
  EXPECT_EQ(json["holds"], false);
  core::expect_words(to_junit(audit), {"tests=\"3\" failures=\"1\"", "<failure message=\"order: fails, "});
}

TEST(DoorSolvers, SayWhatCannotBeSeen) {
  OwnKepler own{"verlet"};
  own.with_velocities = false;
  const SolverAudit audit = kepler_audit(own, 2);
  EXPECT_TRUE(audit.holds);
  EXPECT_NEAR(*audit.verdicts[0].measured, 2, 0.1);
  core::expect_words(audit.verdicts[1].reason, {"do not have all positions and velocities"});
  core::expect_words(audit.verdicts[2].reason, {"do not have all positions and velocities"});
}

TEST(DoorSolvers, GoOnWhereOneSceneFails) {
  SolverRequest request{.scenes = {load_scene("simple_pendulum"), load_scene("kepler")}};
  request.solve = [](const SolverTask& task) -> std::string {
    if (task.scene.name() == "simple_pendulum") throw Error("no rods here");
    return OwnKepler{"verlet"}(task);
  };
  request.until = Number(4);
  const SolverAudit audit = audit_solver(request);
  ASSERT_EQ(audit.verdicts.size(), 4u);
  EXPECT_EQ(audit.verdicts[0].verdict, "not run");
  core::expect_words(audit.verdicts[0].reason, {"no rods here"});
  EXPECT_FALSE(audit.decided);
  EXPECT_TRUE(audit.holds);
}

/// Nonsense is no order, and a file without numbers is told.
TEST(DoorSolvers, RefuseNonsense) {
  SolverRequest request{.order = 2, .scenes = {load_scene("kepler")}};
  EXPECT_THROW(audit_solver(request), InputError);
  request.solve = [](const SolverTask&) { return std::string("t,planet.x\n0,nan\n1,nan\n"); };
  EXPECT_FALSE(audit_solver(request).decided);
  request.order = 0;
  EXPECT_THROW(audit_solver(request), InputError);
}

/// As Ctrl-C does.
TEST(DoorSolvers, EndWhenTheyAreAskedTo) {
  std::stop_source source;
  source.request_stop();
  SolverRequest request{.solve = OwnKepler{"verlet"}, .scenes = {load_scene("kepler")}};
  request.stop = source.get_token();
  EXPECT_THROW(audit_solver(request), Interrupted);
}

}  // namespace
}  // namespace hbvm

#include "hbvm/analysis/run/health.hpp"

#include <gtest/gtest.h>

#include <set>

#include "hbvm/analysis/run/run.hpp"
#include "hbvm/step/registry.hpp"

namespace hbvm {
namespace {

RunResult result_of(const Scene& scene, const char* method, const char* step, const char* until,
                    const char* precision = "double", SolverKind solver = SolverKind::automatic) {
  return run({scene, parse_method(method), solver, Expression::parse(step), Expression::parse(until),
              Precision::parse(precision)},
             {});
}

std::string warnings(const Health& health) {
  std::set<std::string> names;
  for (const Warning& warning : health.warnings) names.insert(warning.name);
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : " ") + name;
  return all;
}

std::string warnings(const char* scene, const char* method, const char* step, const char* until) {
  return warnings(result_of(load_scene(scene), method, step, until).health);
}

TEST(Health, OfOrderlyRunsHasNoWarnings) {
  EXPECT_EQ(warnings("double_pendulum", "hbvm:3,3", "1/16", "20"), "");
  EXPECT_EQ(warnings("tethered_satellites", "hbvm:5,1", "0.1", "100"), "");
  EXPECT_EQ(warnings("tethered_satellites", "hbvm:5,3", "0.1", "100"), "");
  EXPECT_EQ(warnings("heavy_top", "hbvm:3,3", "1/16", "20"), "");
  EXPECT_EQ(warnings("chain", "hbvm:3,3", "1/100", "10"), "");
  EXPECT_EQ(warnings("four_bar_linkage", "hbvm:3,3", "1/100", "10"), "");
  EXPECT_EQ(warnings("modified_pendulum", "hbvm:4,2", "1/16", "20"), "");
  EXPECT_EQ(warnings("kepler", "hbvm:12,4", "2*pi/64", "20*pi"), "");
  EXPECT_EQ(warnings("kepler", "hbvm:12,1", "2*pi/64", "20*pi"), "");
}

TEST(Health, NamesWhatIsWrong) {
  EXPECT_EQ(warnings("tethered_satellites", "hbvm:1,1", "0.1", "100"), "energy_lost");
  EXPECT_EQ(warnings("kepler", "hbvm:2,2", "2*pi/64", "2*pi"), "energy_lost");
  EXPECT_EQ(warnings("chain", "hbvm:2,2", "1/100", "20"), "even_s_drift");
  EXPECT_EQ(warnings("heavy_top", "hbvm:4,2", "1/100", "20"), "even_s_drift");
  EXPECT_EQ(warnings("simple_pendulum", "hbvm:1,1", "1/2", "20"), "hidden_constraint_large step_too_large");
}

TEST(Health, SaysWhatWouldConserveTheEnergy) {
  const auto text = [](const char* method) {
    return result_of(load_scene("kepler"), method, "2*pi/64", "2*pi").health.warnings.at(0).text;
  };
  EXPECT_NE(text("hbvm:2,2").find("hbvm:auto,2"), std::string::npos);
}

/// A body on a stiff spring, omega = 1e4.
TEST(Health, OfAStiffSpringThatTheStepDoesNotResolveWarns) {
  const Scene spring = read_scene(
      "dimension = 2\npoint = [{name = \"o\", position = [0, 0]}]\n"
      "body = [{name = \"a\", mass = 1, position = [\"3/5\", \"-4/5\"], velocity = [\"2/5\", \"3/10\"]}]\n"
      "effect = [{kind = \"spring\", between = [\"o\", \"a\"], stiffness = \"10^8\"}]\n",
      "stiff spring");
  EXPECT_EQ(warnings(result_of(spring, "hbvm:2,2", "1/100", "1", "double", SolverKind::newton).health),
            "step_too_large");
  EXPECT_EQ(warnings(result_of(spring, "hbvm:2,2", "1/100000", "1/100").health), "");
}

/// A four-bar linkage with one crank longer by 1e-10, which turns through its folded position at t = 0.73: every step
/// that does not resolve 1e-5 crosses it on a straight line, with energy and constraints at round-off.
const std::string folding =
    "dimension = 2\n[constants]\nd = \"1e-10\"\n"
    "[[point]]\nname = \"l\"\nposition = [0, 0]\n[[point]]\nname = \"r\"\nposition = [2, 0]\n"
    "[[body]]\nname = \"a\"\nmass = 1\nposition = [0, 1]\nvelocity = [2, 0]\n"
    "[[body]]\nname = \"b\"\nmass = 2\n"
    "position = [\"1.999999999999999999997499999999999999999998437500000156249999982421875\", "
    "\"1.00000000009999999999999999999999999999999687500000031249999996484375\"]\n"
    "velocity = [\"1.9999999999999999999999999999997500000000249999999970312500003515625\", "
    "\"0.000000000000000000004999999999500000000053124999993750000000738281249911328125011897425086\"]\n"
    "[[constraint]]\nkind = \"rod\"\nbetween = [\"l\", \"a\"]\nlength = 1\n"
    "[[constraint]]\nkind = \"rod\"\nbetween = [\"a\", \"b\"]\nlength = 2\n"
    "[[constraint]]\nkind = \"rod\"\nbetween = [\"b\", \"r\"]\nlength = \"1+d\"\n"
    "[[effect]]\nkind = \"uniform_gravity\"\nacceleration = [0, -1]\n";

TEST(Health, OfALinkageThatTunnelsWarnsAtEveryStepAndPrecision) {
  const Scene scene = read_scene(folding, "folding");
  for (const char* step : {"1/16", "1/20", "1/64", "1/256", "1/1024"})
    for (const char* method : {"hbvm:3,3", "hbvm:4,2"}) {
      const RunResult result = result_of(scene, method, step, "1");
      EXPECT_NE(warnings(result.health).find("near_singular_constraints"), std::string::npos) << step << method;
      EXPECT_LT(std::stod(result.e_H), 1e-10);
    }
  for (const char* precision : {"quad", "mpfr:50"})
    EXPECT_NE(warnings(result_of(scene, "hbvm:3,3", "1/128", "1", precision).health).find("near_singular"),
              std::string::npos);
  EXPECT_EQ(warnings(result_of(scene, "hbvm:3,3", "1/128", "5/8").health), "") << "before the fold";
}

TEST(Health, OfConstraintsThatLeaveLambdaFewDigitsWarns) {
  // A body held by two nearly collinear rods, at rest but for a slow turn.
  const Scene scene = read_scene(
      "dimension = 3\n[constants]\nr = \"1e-5\"\n"
      "[[point]]\nname = \"l\"\nposition = [-1, 0, 0]\n[[point]]\nname = \"r\"\nposition = [\"8/5\", 0, 0]\n"
      "[[body]]\nname = \"b\"\nmass = 1\nposition = [0, \"-r\", 0]\nvelocity = [0, 0, \"r\"]\n"
      "[[constraint]]\nkind = \"rod\"\nbetween = [\"l\", \"b\"]\nlength = \"sqrt(1+r^2)\"\n"
      "[[constraint]]\nkind = \"rod\"\nbetween = [\"b\", \"r\"]\nlength = \"sqrt(2.56+r^2)\"\n",
      "two rods");
  const Health in_double = result_of(scene, "hbvm:1,1", "1/16", "1/2").health;
  EXPECT_NE(warnings(in_double).find("near_singular_constraints"), std::string::npos);
  // sin of the angle: r (1 + 5/8); condition (2 / sin)^2.
  EXPECT_NEAR(std::stod(in_double.condition) / (4 / (1.625e-5 * 1.625e-5)), 1, 1e-2);
  EXPECT_EQ(warnings(result_of(scene, "hbvm:1,1", "1/16", "1/2", "quad", SolverKind::newton).health), "");
}

/// A double pendulum whose end is light, and a free heavy body beside it, in units of these lengths, masses and times.
Scene in_units(const std::string& length, const std::string& mass, const std::string& time) {
  const std::string speed = length + "/" + time;
  const auto both = [](const char* x, const char* y, const std::string& unit) {
    return std::string("[\"") + x + "*(" + unit + ")\", \"" + y + "*(" + unit + ")\"]";
  };
  return read_scene(
      "dimension = 2\npoint = [{name = \"o\", position = [0, 0]}]\n"
      "body = [{name = \"a\", mass = \"2*" +
          mass + "\", position = " + both("0.8", "(-0.6)", length) + ", velocity = " + both("0.3", "0.4", speed) +
          "},\n{name = \"b\", mass = \"" + mass + "/10^9\", position = " + both("1.3", "(-1.8)", length) +
          ", velocity = " + both("(-0.3)", "0.15", speed) + "},\n{name = \"heavy\", mass = \"" + mass +
          "*10^6\", position = " + both("5", "5", length) + ", velocity = " + both("1", "7", speed) +
          "}]\n"
          "constraint = [{kind = \"rod\", between = [\"o\", \"a\"], length = \"" +
          length +
          "\"},\n"
          "{kind = \"rod\", between = [\"a\", \"b\"], length = \"1.3*" +
          length +
          "\"}]\n"
          "effect = [{kind = \"uniform_gravity\", acceleration = [0, \"-(" +
          length + ")/(" + time + ")^2\"]}]\n",
      "units");
}

TEST(Health, DoesNotDependOnTheUnits) {
  const Health one =
      result_of(in_units("1", "1", "1"), "hbvm:2,2", "1/2", "32", "double", SolverKind::fixed_point).health;
  EXPECT_NE(one.warnings.size(), 0u);
  for (const auto& [length, mass, time] :
       {std::tuple("2^(-33)", "1", "1"), {"1", "2^40", "1"}, {"2^21", "2^(-50)", "2^12"}}) {
    const std::string step = "1/2*" + std::string(time), until = "32*" + std::string(time);
    const Health scaled = result_of(in_units(length, mass, time), "hbvm:2,2", step.c_str(), until.c_str(), "double",
                                    SolverKind::fixed_point)
                              .health;
    EXPECT_EQ(scaled.condition, one.condition);
    EXPECT_EQ(scaled.worst_e_H, one.worst_e_H);
    EXPECT_EQ(scaled.worst_hidden, one.worst_hidden);
    EXPECT_EQ(warnings(scaled), warnings(one));
  }
}

TEST(Health, OfALightEndIsThatOfTheLightEnd) {
  // A heavy body moves fast and freely; the light end of the pendulum is what the step does not resolve.
  const Health health = result_of(in_units("1", "1", "1"), "hbvm:2,2", "1/2", "32").health;
  EXPECT_NE(warnings(health).find("step_too_large"), std::string::npos);
  for (const Warning& warning : health.warnings)
    if (warning.name == "step_too_large") {
      EXPECT_NE(warning.text.find("q_3..q_4"), std::string::npos) << warning.text;
    }
  EXPECT_EQ(warnings(result_of(in_units("1", "1", "1"), "hbvm:3,3", "1/64", "8").health), "");
}

TEST(HealthText, HasALineForEach) {
  const std::string text = to_text(Health{"2", "3e-16", "1e-4", {{"energy_lost", "a"}, {"step_too_large", "b"}}});
  EXPECT_EQ(text,
            "what the run is worth\n  energy error, of H's greatest term  3e-16\n"
            "  condition of the Gram matrix        2\n  velocity off the tangent space      1e-4\n"
            "  WARNING energy_lost: a\n  WARNING step_too_large: b\n");
}

}  // namespace
}  // namespace hbvm

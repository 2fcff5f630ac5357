#include "run/health.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <set>

#include "method/tableaux.hpp"
#include "run/scene_run.hpp"
#include "runs/request_of.hpp"
#include "step/tableau_method.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

hbvm::Run result_of(const Scene& scene, const char* method, const char* step, const char* until,
                    const char* precision = "double", SolverKind solver = SolverKind::automatic) {
  return run(request_of(scene, method, step, until, precision, solver), {});
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

std::string text_of(const Health& health, const std::string& name) {
  for (const Warning& warning : health.warnings)
    if (warning.name == name) return warning.text;
  return {};
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
  const Health health = result_of(load_scene("kepler"), "hbvm:2,2", "2*pi/64", "2*pi").health;
  expect_words(health.warnings.at(0).text, {"hbvm:auto,2"});
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

/// A four-bar linkage with one crank longer by 1e-10, which turns through its folded position at t = 0.73. Every step
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
      const hbvm::Run result = result_of(scene, method, step, "1");
      expect_words(warnings(result.health), {"near_singular_constraints"});
      EXPECT_LT(std::stod(result.e_H), 1e-10);
    }
  for (const char* precision : {"quad", "mpfr:50"})
    expect_words(warnings(result_of(scene, "hbvm:3,3", "1/128", "1", precision).health), {"near_singular"});
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
  expect_words(warnings(in_double), {"near_singular_constraints"});
  // sin of the angle: r (1 + 5/8); condition (2 / sin)^2.
  EXPECT_NEAR(std::stod(in_double.condition) / (4 / (1.625e-5 * 1.625e-5)), 1, 1e-2);
  EXPECT_EQ(warnings(result_of(scene, "hbvm:1,1", "1/16", "1/2", "quad", SolverKind::newton).health), "");
}

/// A double pendulum whose end is light, and a free heavy body beside it, in units of these lengths, masses and times.
Scene in_units(const std::string& length, const std::string& mass, const std::string& time) {
  return read_scene("constants = { L = \"" + length + "\", M = \"" + mass + "\", T = \"" + time + "\" }\n" + R"(
dimension = 2
point = [{ name = "o", position = [0, 0] }]
body = [{ name = "a", mass = "2*M", position = ["0.8*L", "-0.6*L"], velocity = ["0.3*L/T", "0.4*L/T"] },
        { name = "b", mass = "M/10^9", position = ["1.3*L", "-1.8*L"], velocity = ["-0.3*L/T", "0.15*L/T"] },
        { name = "heavy", mass = "M*10^6", position = ["5*L", "5*L"], velocity = ["L/T", "7*L/T"] }]
constraint = [{ kind = "rod", between = ["o", "a"], length = "L" },
              { kind = "rod", between = ["a", "b"], length = "1.3*L" }]
effect = [{ kind = "uniform_gravity", acceleration = [0, "-L/T^2"] }]
)",
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
  expect_words(warnings(health), {"step_too_large"});
  expect_words(text_of(health, "step_too_large"), {"q_3..q_4"});
  EXPECT_EQ(warnings(result_of(in_units("1", "1", "1"), "hbvm:3,3", "1/64", "8").health), "");
}

MethodPtr explicit_euler() { return std::make_shared<TableauMethod>(tableau({{"0"}}, {"1"}, {"0"}), "euler.toml"); }
MethodPtr classical() { return std::make_shared<TableauMethod>(rk4(), "rk4.toml"); }

hbvm::Run result_of(const Scene& scene, MethodPtr method, const char* step, const char* until,
                    OnFailure on_failure = OnFailure::stop) {
  RunRequest request = request_of(scene, "hbvm:1,1", step, until);
  request.method = std::move(method);
  request.on_failure = on_failure;
  return run(request, {});
}

/// What is lost is seen of every method by what it did.
TEST(Health, OfAMethodThatLosesItsMotionWarns) {
  const Health health = result_of(load_scene("double_pendulum"), classical(), "1/16", "600").health;
  EXPECT_EQ(warnings(health), "constraint_drift energy_changed");
  // The rods are 2.4 and 0.6 of their length long by then.
  expect_words(text_of(health, "constraint_drift"), {"rod 'a'-'b'", "at t = 6.000e+02", "more than 1/100 at t = 1.06"});
  expect_words(text_of(health, "energy_changed"), {"more than 1/20 of it at t = 1.55", "hbvm:auto,3"});
}

TEST(Health, OfMethodsThatDoNotConserveButResolveTheMotionIsNoAlarm) {
  const Scene pendulum = load_scene("double_pendulum"), kepler = load_scene("kepler"), top = load_scene("heavy_top");
  EXPECT_EQ(warnings(result_of(pendulum, classical(), "1/64", "20").health), "");
  EXPECT_EQ(warnings(result_of(top, classical(), "1/64", "10").health), "");
  EXPECT_EQ(warnings(result_of(kepler, classical(), "2*pi/256", "20*pi").health), "");
  for (const char* method : {"rattle", "compose:rattle,4", "lobatto:3", "energy_momentum", "rkf78"}) {
    EXPECT_EQ(warnings(result_of(pendulum, parse_method(method), "1/32", "20").health), "") << method;
    EXPECT_EQ(warnings(result_of(kepler, parse_method(method), "2*pi/128", "20*pi").health), "") << method;
  }
}

/// An orbit of eccentricity 0.99999, whose kinetic energy at the pericentre is 10^5 times what it usually is.
Scene comet(const char* x, const char* vy, const std::string& e = "0.99999") {
  return read_scene(std::string("dimension = 2\n[constants]\ne = \"" + e +
                                "\"\n[[point]]\nname = \"sun\"\nposition = [0, 0]\n"
                                "[[body]]\nname = \"comet\"\nmass = 1\nposition = [\"") +
                        x + "\", 0]\nvelocity = [0, \"" + vy +
                        "\"]\n[[effect]]\nkind = \"central_gravity\"\ncenter = \"sun\"\nstrength = 1\n",
                    "comet");
}

TEST(Health, OfANarrowOrbitComparesWithWhatTheEnergyUsuallyIs) {
  const Scene near = comet("1-e", "sqrt((1+e)/(1-e))"), far = comet("-1-e", "-sqrt((1-e)/(1+e))");
  for (const Scene* scene : {&near, &far})
    for (const char* method : {"rkf78", "rattle", "bulirsch_stoer:12"})
      EXPECT_NE(text_of(result_of(*scene, parse_method(method), "2*pi/64", "20*pi").health, "energy_changed"), "")
          << method;
}

TEST(Health, OfDividedStepsWarnsWhereTheyDecide) {
  const Health narrow =
      result_of(comet("-1-e", "-sqrt((1-e)/(1+e))"), parse_method("hbvm:auto,5"), "2*pi/1000", "2*pi", OnFailure::halve)
          .health;
  expect_words(text_of(narrow, "steps_divided"),
               {"of 1000 steps failed", "down to h/32768", "first at t = 3.135", "--error"});
  // Ten steps of a spring that the fixed-point iteration makes only with omega h below some 1.
  RunRequest spring = request_of(read_scene("dimension = 2\npoint = [{name = \"o\", position = [0, 0]}]\n"
                                            "body = [{name = \"a\", mass = 1, position = [1, 0], velocity = [0, 1]}]\n"
                                            "effect = [{kind = \"spring\", between = [\"o\", \"a\"], stiffness = 1}]\n",
                                            "spring"),
                                 "hbvm:2,2", "16", "160", "double", SolverKind::fixed_point);
  spring.on_failure = OnFailure::halve;
  expect_words(text_of(run(spring, {}).health, "steps_divided"), {"10 of 10 steps failed"});
  spring.step = Expression::parse("1/4");
  EXPECT_EQ(text_of(run(spring, {}).health, "steps_divided"), "");
}

/// Mechanisms of which some point, joint or body is at rest. What the constraints there show is rounding, or small
/// beside the speed of what moves.
const std::string in_gravity = "dimension = 2\n[[effect]]\nkind = \"uniform_gravity\"\nacceleration = [0, \"-9.81\"]\n";
const std::string crank =
    "[[point]]\nname = \"bearing\"\nposition = [0, 0]\n"
    "[[rigid_body]]\nname = \"crank\"\nposition = [0, 0]\nvelocity = [0, 0]\nmass = 1\ncenter = [\"1/2\", 0]\n"
    "second_moment = [[\"1/3\", 0], [0, \"1/300\"]]\ndirectors = [[1, 0], [0, 1]]\nangular_velocity = 2\n"
    "[[constraint]]\nkind = \"ball_joint\"\nbetween = [\"bearing\", { of = \"crank\", at = [0, 0] }]\n";
/// The crank drives a slider on the axis, which at the start is farthest out and at rest.
const std::string slider =
    "[[body]]\nname = \"slider\"\nmass = 2\nposition = [4, 0]\nvelocity = [0, 0]\n"
    "[[constraint]]\nkind = \"plane\"\nbody = \"slider\"\nnormal = [0, 1]\noffset = 0\n"
    "[[constraint]]\nkind = \"rod\"\nbetween = [{ of = \"crank\", at = [1, 0] }, \"slider\"]\nlength = 3\n";
/// A heavy frame on three rods, at rest, on which a linkage turns.
const std::string frame =
    "[[point]]\nname = \"p\"\nposition = [0, -1]\n[[point]]\nname = \"q\"\nposition = [4, -1]\n"
    "[[point]]\nname = \"r\"\nposition = [-1, 0]\n"
    "[[rigid_body]]\nname = \"frame\"\nposition = [0, 0]\nvelocity = [0, 0]\nmass = 50\ncenter = [2, 0]\n"
    "second_moment = [[300, 0], [0, 1]]\ndirectors = [[1, 0], [0, 1]]\nangular_velocity = 0\n"
    "[[body]]\nname = \"a\"\nmass = 1\nposition = [\"-3/5\", \"4/5\"]\nvelocity = [\"4/5\", \"3/5\"]\n"
    "[[constraint]]\nkind = \"rod\"\nbetween = [\"p\", { of = \"frame\", at = [0, 0] }]\nlength = 1\n"
    "[[constraint]]\nkind = \"rod\"\nbetween = [\"q\", { of = \"frame\", at = [4, 0] }]\nlength = 1\n"
    "[[constraint]]\nkind = \"rod\"\nbetween = [\"r\", { of = \"frame\", at = [0, 0] }]\nlength = 1\n"
    "[[constraint]]\nkind = \"rod\"\nbetween = [{ of = \"frame\", at = [0, 0] }, \"a\"]\nlength = 1\n";
/// A disc that turns about its own centre, which is held, with a weight at its rim.
const std::string wheel =
    "[[point]]\nname = \"axle\"\nposition = [1, 1]\n"
    "[[rigid_body]]\nname = \"wheel\"\nposition = [1, 1]\nvelocity = [0, 0]\nmass = 3\ncenter = [0, 0]\n"
    "second_moment = [[\"3/4\", 0], [0, \"3/4\"]]\ndirectors = [[1, 0], [0, 1]]\nangular_velocity = 7\n"
    "[[constraint]]\nkind = \"ball_joint\"\nbetween = [\"axle\", { of = \"wheel\", at = [0, 0] }]\n";
/// A bar that hangs at rest from its bearing.
const std::string hanging =
    "[[point]]\nname = \"bearing\"\nposition = [0, 0]\n"
    "[[rigid_body]]\nname = \"bar\"\nposition = [0, 0]\nvelocity = [0, 0]\nmass = 1\ncenter = [\"1/2\", 0]\n"
    "second_moment = [[\"1/3\", 0], [0, \"1/300\"]]\ndirectors = [[0, -1], [1, 0]]\nangular_velocity = 0\n"
    "[[constraint]]\nkind = \"ball_joint\"\nbetween = [\"bearing\", { of = \"bar\", at = [0, 0] }]\n";

TEST(Health, OfMechanismsWithPartsAtRestIsNoAlarm) {
  for (const std::string& text :
       {in_gravity + crank, in_gravity + crank + slider, in_gravity + frame, in_gravity + wheel, in_gravity + hanging})
    for (const char* step : {"1/500", "1/50"})
      for (const char* method : {"hbvm:3,3", "hbvm:auto,3", "rattle"}) {
        const Health health = result_of(read_scene(text, "mechanism"), method, step, "2").health;
        EXPECT_EQ(warnings(health), "") << step << method << text;
      }
}

TEST(Health, OfAMechanismThatTheStepDoesNotResolveWarns) {
  for (const std::string& text : {in_gravity + crank, in_gravity + crank + slider})
    EXPECT_NE(
        text_of(result_of(read_scene(text, "mechanism"), "hbvm:1,1", "1/4", "4").health, "hidden_constraint_large"),
        "");
}

/// Advice is something else than what is being done.
TEST(Health, DoesNotAdviseWhatIsDone) {
  for (const char* method : {"hbvm:auto,3", "hbvm:auto,2", "hbvm:2,2"}) {
    const Health health =
        result_of(comet("-1-e", "-sqrt((1-e)/(1+e))", "0.9"), parse_method(method), "2*pi/16", "2*pi", OnFailure::halve)
            .health;
    EXPECT_NE(health.warnings.size(), 0u) << method;
    for (const Warning& warning : health.warnings)
      EXPECT_EQ(warning.text.find(method), std::string::npos) << warning.text;
  }
}

/// A run that ends long after its motion was lost says so, and not what else may end one.
TEST(Health, OfARunThatFailsSaysWhatWasLostBefore) {
  const auto message = [](const char* scene, const MethodPtr& method, const char* step, const char* until) {
    return message_of<IntegrationError>([&] { result_of(load_scene(scene), method, step, until); });
  };
  const std::string overflow = message("quartic_oscillator", explicit_euler(), "1/4", "100");
  expect_words(overflow, {"is not finite", "H had changed by more than 1/20", "from t = ", "take a smaller step"});
  EXPECT_EQ(overflow.find("singularity"), std::string::npos) << overflow;
  const std::string singular = message("double_pendulum", classical(), "1/16", "700");
  expect_words(singular, {"near_singular_constraints", "H had changed by more than 1/20", "from t = 1.55",
                          "rod 'a'-'b' had drifted by more than 1/100 from t = 1.06"});
  EXPECT_EQ(singular.find("more digits"), std::string::npos) << singular;
}

}  // namespace
}  // namespace hbvm::core

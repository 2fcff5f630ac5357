#include "step/registry.hpp"

#include "folder.hpp"
#include "printing.hpp"
#include "problem/state_evaluator.hpp"
#include "step/hbvm_method.hpp"
#include "step/stepping.hpp"
#include "step/tableau_method.hpp"
#include "verification/models.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

/// A method in a file, which is thrown away in the end.
struct Midpoint {
  const Folder folder;
  const std::string name =
      "tableau:" + folder.write("midpoint.toml", "name = \"midpoint\"\nA = [[\"1/2\"]]\nb = [1]\n");
};

TEST(Registry, ReadsWhatAMethodSaysOfItself) {
  const Midpoint midpoint;
  for (const std::string& text : std::vector<std::string>{
           "hbvm:4,2", "hbvm:auto,3", "rattle", "compose:rattle,6", "energy_momentum", "projected_hbvm:4,2",
           "restored_hbvm:3,3", "rkf78", "bulirsch_stoer:12", "compose:hbvm:1,1,4", "rk4", "rk4+project",
           "rk4+baumgarte:5,1/2", "dopri5+ggl", "sdirk:3", "radau:3+project", "symplectic_euler", midpoint.name,
           midpoint.name + "+project"})
    EXPECT_EQ(parse_method(text)->text(), text);
}

TEST(Registry, KnowsMethodsByOtherNames) {
  for (const auto& [name, meant] : {std::pair("verlet", "rattle"),
                                    {"leapfrog", "rattle"},
                                    {"gauss:3", "hbvm:3,3"},
                                    {"midpoint", "hbvm:1,1"},
                                    {"implicit_euler", "radau:1"},
                                    {"rk45", "dopri5"}}) {
    EXPECT_TRUE(is_method_name(MethodSpec::parse(name).family)) << name;
    EXPECT_EQ(parse_method(name)->text(), meant);
  }
  EXPECT_FALSE(is_method_name("adams"));
}

/// The example of each family is made, and its row in the list is filled.
TEST(Registry, ListsWhatCanBeMade) {
  for (const MethodFamily& family : method_families()) {
    EXPECT_FALSE(family.form.empty() || family.order.empty() || family.work.empty()) << family.name;
    if (family.name == "tableau") continue;
    EXPECT_EQ(parse_method(family.example)->text(), family.example);
    if (family.formulated) {
      EXPECT_TRUE(parse_method(std::string(family.example) + "+project")->kept().constraints);
      EXPECT_FALSE(parse_method(std::string(family.example) + "+baumgarte:5,5")->kept().constraints);
    }
  }
}

TEST(Registry, MethodsSayWhatTheyAre) {
  const Midpoint midpoint;
  const MethodPtr hbvm = parse_method("hbvm:4,2"), gauss = parse_method("hbvm:3,3"), rattle = parse_method("rattle"),
                  six = parse_method("compose:rattle,6"), plain = parse_method(midpoint.name),
                  projected = parse_method(midpoint.name + "+project");
  EXPECT_EQ(hbvm->title(), "HBVM(4,2)");
  EXPECT_EQ(hbvm->order(), 4);
  EXPECT_EQ(hbvm->parameters().at("k").text(), "4");
  EXPECT_EQ(hbvm->parameters().at("s").text(), "2");
  EXPECT_TRUE(hbvm->kept().energy);
  EXPECT_FALSE(hbvm->kept().momenta);
  EXPECT_TRUE(gauss->kept().momenta);
  EXPECT_EQ(rattle->order(), 2);
  EXPECT_TRUE(rattle->kept().hidden);
  EXPECT_FALSE(rattle->kept().energy);
  EXPECT_EQ(six->order(), 6);
  EXPECT_EQ(six->terms(), 25 * rattle->terms());
  EXPECT_TRUE(six->kept().constraints);
  EXPECT_EQ(plain->title(), "midpoint");
  EXPECT_EQ(plain->order(), 2);
  EXPECT_TRUE(plain->kept().momenta);
  EXPECT_TRUE(plain->kept().reversal);
  EXPECT_FALSE(plain->kept().constraints);
  EXPECT_TRUE(projected->kept().constraints);
  EXPECT_FALSE(projected->kept().reversal);
  EXPECT_NE(plain->key(), projected->key());
  EXPECT_TRUE(as_hbvm(*hbvm));
  EXPECT_FALSE(as_hbvm(*plain));
  EXPECT_TRUE(as_tableau(*plain));
}

TEST(Registry, RefusesWhatThereIsNot) {
  const auto refusal = [](const std::string& text) { return message_of([&] { parse_method(text); }); };
  struct Refused {
    std::string family;
    std::vector<const char*> arguments;
  };
  for (const auto& [family, arguments] :
       {Refused{"", {""}}, Refused{"gauss", {"", ":", ":x", ":0", ":2,2"}},
        Refused{"rk4", {":4", "+projects", "+baumgarte", "+baumgarte:1", "+ggl:1"}},
        Refused{"verlet", {":2", "+project"}}, Refused{"sdirk", {"", ":4", ":3+projects"}},
        Refused{"radau", {"", ":0", ":x"}}, Refused{"hbvm", {"", ":2,3", ":2"}}, Refused{"rattle", {":2"}},
        Refused{"compose", {"", ":rattle", ":rattle,", ":rattle,3", ":rattle,0", ":rattle,14", ":rattle,4x"}},
        Refused{"compose", {":hbvm:2,2,4", ":gauss,4", ":projected_hbvm:1,1,4", ":rkf78,4"}},
        Refused{"energy_momentum", {":2"}}, Refused{"rkf78", {":8"}},
        Refused{"lobatto", {"", ":", ":1", ":0", ":201", ":3x"}},
        Refused{"bulirsch_stoer", {"", ":", ":0", ":-3", ":1001", ":1e-8", ":8x"}},
        Refused{"tableau", {"", ":", ":+project", ":no such file.toml"}}})
    for (const char* const more : arguments) EXPECT_NE(refusal(family + more), "") << family << more;
  for (const std::string family : {"projected_hbvm", "restored_hbvm"})
    for (const char* const arguments : {"", ":", ":2", ":2,3", ":0,0", ":2,2x", ":auto,2"})
      expect_words(refusal(family + arguments), {family});
  // In short: the names there are, or the near one.
  const std::string unknown = refusal("adams:2");
  for (const MethodFamily& family : method_families()) expect_words(unknown, {std::string(family.name)});
  EXPECT_LT(unknown.size(), 250u);
  expect_words(refusal("gaus:2"), {"did you mean 'gauss'?"});
  expect_words(refusal("rattel"), {"did you mean 'rattle'?"});
}

template <class S>
class EveryMethod : public InDigits<50> {};
TYPED_TEST_SUITE(EveryMethod, AllScalars, ScalarNames);

constexpr const char* constrained_methods[] = {"hbvm:4,2",
                                               "rattle",
                                               "lobatto:3",
                                               "compose:rattle,4",
                                               "compose:hbvm:1,1,4",
                                               "energy_momentum",
                                               "projected_hbvm:4,2",
                                               "restored_hbvm:4,2",
                                               "rkf78",
                                               "symplectic_euler",
                                               "radau:2+project",
                                               "rk4+baumgarte:5,5",
                                               "rk4+ggl",
                                               "bulirsch_stoer:10"};

/// Steppers that one maker makes know nothing of each other.
TYPED_TEST(EveryMethod, MakesSteppersThatAreAlike) {
  using S = TypeParam;
  const Midpoint midpoint;
  const Assembled<S> scene = assemble<S>(load_scene("double_pendulum"));
  std::vector<std::string> methods(std::begin(constrained_methods), std::end(constrained_methods));
  methods.push_back(midpoint.name + "+project");
  for (const std::string& method : methods) {
    const StepperMaker<S> make = parse_method(method)->prepare(scene.problem, SolverKind::automatic);
    const auto one = make(), other = make();
    StepResult<S> step;
    const State<S> first = after<S>(*one, scene, S(1) / 32, 3, &step), second = after<S>(*other, scene, S(1) / 32, 3);
    EXPECT_EQ(step.multiplier->size(), 2) << method;
    EXPECT_EQ(first.q, second.q) << method;
    EXPECT_EQ(first.p, second.p) << method;
  }
}

TYPED_TEST(EveryMethod, GoesOnFromWhatItRemembers) {
  using S = TypeParam;
  const Midpoint midpoint;
  for (const char* const method : constrained_methods)
    for (const char* const scene : {"tethered_satellites", "double_pendulum"}) expect_memory<S>(method, scene, "1/32");
  expect_memory<S>("rattle", "tethered_satellites", "1/8");
  expect_memory<S>("bulirsch_stoer:10", "tethered_satellites", "1");
  expect_memory<S>(midpoint.name, "kepler", "1/16", SolverKind::automatic, 12);
  expect_memory<S>(midpoint.name + "+project", "double_pendulum", "1/32");
}

/// g and the hidden constraints stay round-off in every step.
TYPED_TEST(EveryMethod, ThatKeepsBothConstraintsEndsItsStepsOnThem) {
  using S = TypeParam;
  struct Case {
    const char* method;
    std::vector<const char*> scenes;
    int steps_of_one, steps, g;  // in round-offs of g
  };
  for (const auto& [method, scenes, steps_of_one, steps, g] :
       {Case{"projected_hbvm:4,2", {"tethered_satellites", "modified_pendulum", "heavy_top"}, 16, 20, 32},
        Case{"restored_hbvm:4,2", {"tethered_satellites", "modified_pendulum", "heavy_top"}, 16, 20, 32},
        Case{"lobatto:3", {"double_pendulum", "tethered_satellites", "charged_tetrahedron"}, 64, 16, 32},
        Case{"compose:rattle,4", {"double_pendulum"}, 32, 16, 8},
        Case{"rattle", {"tethered_satellites", "double_pendulum", "heavy_top", "bead_on_ellipsoid"}, 50, 100, 32}})
    for (const char* const name : scenes) {
      SceneSteps<S> run(load_scene(name), method);
      const State<S>& state = run.state;
      StateEvaluator<S> point(run.scene.problem);
      EXPECT_TRUE(parse_method(method)->kept().hidden);
      for (int n = 0; n < steps; ++n) {
        run.step(S(1) / steps_of_one);
        EXPECT_LE(max_norm(point.constraints(state.q)), g * epsilon<S>() * point.constraint_size(state.q))
            << method << ", " << name << ", step " << n;
        EXPECT_LE(max_norm(point.hidden_constraints(state.q, state.p)), 256 * epsilon<S>())
            << method << ", " << name << ", step " << n;
      }
    }
}

/// It is symmetric: with the momentum turned it goes back to where it came from.
TYPED_TEST(EveryMethod, ThatIsSymmetricComesBack) {
  using S = TypeParam;
  struct Case {
    const char* method;
    std::string scene;
    int steps_of_one, steps, in_q, in_p;  // in epsilons
  };
  const std::string bead = scene_path("ellipsoid_bead");
  for (const auto& [method, name, steps_of_one, steps, in_q, in_p] :
       {Case{"energy_momentum", "tethered_satellites", 16, 16, 10'000, 10'000},
        Case{"lobatto:3", "double_pendulum", 64, 16, 4'096, 65'536},
        Case{"lobatto:3", "tethered_satellites", 64, 16, 4'096, 65'536},
        Case{"lobatto:3", "charged_tetrahedron", 64, 16, 4'096, 65'536},
        Case{"compose:rattle,4", "double_pendulum", 32, 16, 10'000, 100'000},
        Case{"rattle", "double_pendulum", 50, 50, 100'000, 100'000}, Case{"hbvm:1,1", bead, 5, 4, 10'000, 10'000},
        Case{"hbvm:4,1", bead, 5, 4, 10'000, 10'000}, Case{"hbvm:2,2", bead, 5, 4, 10'000, 10'000},
        Case{"hbvm:5,3", bead, 5, 4, 10'000, 10'000}}) {
    SCOPED_TRACE(method + (" on " + name));
    SceneSteps<S> run(load_scene(name), method);
    State<S>& state = run.state;
    for (int n = 0; n < steps; ++n) run.step(S(1) / steps_of_one);
    EXPECT_TRUE(parse_method(method)->kept().reversal);
    EXPECT_GT(distance(state.q, run.scene.q0), S(1) / 20);
    state.p = -state.p;
    state.p_carry = -state.p_carry;
    for (int n = 0; n < steps; ++n) run.step(S(1) / steps_of_one);
    EXPECT_LE(distance(state.q, run.scene.q0), in_q * epsilon<S>());
    EXPECT_LE(distance(state.p, Vector<S>(-run.scene.p0)), in_p * epsilon<S>());
  }
}

/// Where a force is not finite, where nothing is found, or where directions are dependent; the next step can be made.
TEST(EveryMethodThatFails, LeavesTheStateAndThenGoesOn) {
  struct Case {
    const char *method, *scene;
    double size;  // 0: a step in the centre
  };
  for (const auto& [method, name, size] :
       {Case{"rattle", "kepler", 0}, Case{"rkf78", "kepler", 0}, Case{"bulirsch_stoer:10", "kepler", 0},
        Case{"projected_hbvm:4,2", "kepler", 0}, Case{"restored_hbvm:4,2", "kepler", 0},
        Case{"energy_momentum", "double_pendulum", 100}, Case{"lobatto:3", "double_pendulum", 100},
        Case{"rattle", "swinging_pendulum", 5}}) {
    SCOPED_TRACE(method + (" on " + std::string(name)));
    SceneSteps<double> run(load_scene(name), method);
    const double in_the_centre = size == 0 ? 0 : 1;
    const State<double> start(run.scene.q0 * in_the_centre, run.scene.p0 * in_the_centre);
    State<double> state = start;
    EXPECT_THROW(run.stepper->step(state, size == 0 ? 1.0 / 8 : size), StageFailure);
    EXPECT_EQ(state.q, start.q);
    EXPECT_EQ(state.p, start.p);
    run.step(1.0 / 128);
    EXPECT_TRUE(run.state.q.allFinite() && run.state.q != run.scene.q0);
  }
}

}  // namespace
}  // namespace hbvm::core

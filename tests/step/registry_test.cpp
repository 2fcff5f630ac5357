#include "step/registry.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "scene/assemble.hpp"
#include "step/hbvm_method.hpp"
#include "step/tableau_method.hpp"

namespace hbvm::core {
namespace {

/// What is thrown away in the end.
class File {
 public:
  explicit File(const std::string& text) {
    const auto* const test = ::testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::temp_directory_path() / ("hbvm_" + std::string(test->name()) + ".toml");
    std::ofstream(path_) << text;
  }
  ~File() { std::filesystem::remove(path_); }
  File(const File&) = delete;
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

constexpr const char* midpoint = "name = \"midpoint\"\nA = [[\"1/2\"]]\nb = [1]\n";

TEST(Registry, ReadsWhatAMethodSaysOfItself) {
  const File file(midpoint);
  for (const std::string& text :
       {std::string("hbvm:4,2"), std::string("hbvm:auto,3"), std::string("rattle"), std::string("compose:rattle,6"),
        std::string("energy_momentum"), std::string("projected_hbvm:4,2"), std::string("restored_hbvm:3,3"),
        std::string("rkf78"), std::string("bulirsch_stoer:12"), std::string("compose:hbvm:1,1,4"),
        "tableau:" + file.path(), "tableau:" + file.path() + "+project"})
    EXPECT_EQ(parse_method(text)->text(), text);
}

TEST(Registry, MethodsSayWhatTheyAre) {
  const File file(midpoint);
  const MethodPtr hbvm = parse_method("hbvm:4,2"), gauss = parse_method("hbvm:3,3"), rattle = parse_method("rattle"),
                  six = parse_method("compose:rattle,6"), plain = parse_method("tableau:" + file.path()),
                  projected = parse_method("tableau:" + file.path() + "+project");
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
  const auto refusal = [](const std::string& text) -> std::string {
    try {
      parse_method(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  for (const char* const text : {"",
                                 "gauss",
                                 "hbvm",
                                 "hbvm:2,3",
                                 "hbvm:2",
                                 "rattle:2",
                                 "compose",
                                 "compose:rattle",
                                 "compose:rattle,",
                                 "compose:rattle,3",
                                 "compose:rattle,0",
                                 "compose:rattle,14",
                                 "compose:rattle,4x",
                                 "compose:hbvm:2,2,4",
                                 "compose:gauss,4",
                                 "compose:projected_hbvm:1,1,4",
                                 "compose:rkf78,4",
                                 "energy_momentum:2",
                                 "projected_hbvm:2,3",
                                 "restored_hbvm:auto,2",
                                 "rkf78:8",
                                 "bulirsch_stoer:0",
                                 "tableau",
                                 "tableau:",
                                 "tableau:+project",
                                 "tableau:no such file.toml"})
    EXPECT_NE(refusal(text), "") << text;
  // In short: the names there are, or what it is called here.
  const std::string unknown = refusal("adams:2");
  for (const MethodFamily& family : method_families()) EXPECT_NE(unknown.find(family.name), std::string::npos);
  EXPECT_LT(unknown.size(), 250u);
  EXPECT_EQ(refusal("gauss:2"),
            "unknown method 'gauss:2': take hbvm:S,S, which is Gauss with S stages where there are no constraints");
  EXPECT_NE(refusal("rattel").find("did you mean 'rattle'?"), std::string::npos);
}

/// Each makes steppers for every number type, one after the other, that know nothing of each other.
template <Scalar S>
void expect_equal_steppers(const Method& method) {
  const Assembled<S> scene = assemble<S>(load_scene("double_pendulum"));
  const StepperMaker<S> make = method.prepare(scene.problem, SolverKind::automatic);
  std::optional<State<S>> first;
  for (int n = 0; n < 2; ++n) {
    State<S> state(scene.q0, scene.p0);
    const std::unique_ptr<Stepper<S>> stepper = make();
    for (int i = 0; i < 3; ++i) stepper->step(state, S(S(1) / 32));
    EXPECT_EQ(stepper->multiplier().size(), 2);
    if (first) {
      EXPECT_EQ(state.q, first->q) << method.text();
      EXPECT_EQ(state.p, first->p) << method.text();
    }
    first.emplace(state);
  }
}

TEST(Registry, MethodsMakeSteppers) {
  const PrecisionScope digits(40);
  const File file(midpoint);
  for (const std::string& text :
       {std::string("hbvm:4,2"), std::string("rattle"), std::string("compose:rattle,4"), std::string("energy_momentum"),
        std::string("projected_hbvm:4,2"), std::string("restored_hbvm:4,2"), std::string("rkf78"),
        std::string("bulirsch_stoer:8"), "tableau:" + file.path() + "+project"}) {
    const MethodPtr method = parse_method(text);
    expect_equal_steppers<double>(*method);
    expect_equal_steppers<Quad>(*method);
    expect_equal_steppers<Mpfr>(*method);
  }
}

}  // namespace
}  // namespace hbvm::core

#include "run/describe.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "hbvm/error.hpp"
#include "scalar/literal.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

/// The lines of a description: what stands on the left, and the values beside it.
class Description {
 public:
  explicit Description(const std::string& scene, const std::string& precision = "double")
      : text_(to_text(describe(read_scene(scene, "test.toml"), Precision::parse(precision)))) {
    std::istringstream lines(text_);
    std::getline(lines, first);
    for (std::string line; std::getline(lines, line);) {
      const std::string left = trimmed(line.substr(0, 24));
      lines_.emplace_back(left, trimmed(line.substr(std::min<std::size_t>(24, line.size()))));
    }
  }

  std::string first;
  std::vector<std::string> all(const std::string& what) const {
    std::vector<std::string> values;
    for (const auto& [left, value] : lines_)
      if (left == what) values.push_back(value);
    return values;
  }
  std::string operator[](const std::string& what) const {
    const auto values = all(what);
    EXPECT_EQ(values.size(), 1u) << what << " in\n" << text_;
    return values.empty() ? std::string() : values[0];
  }
  bool has(const std::string& what) const { return !all(what).empty(); }

 private:
  static std::string trimmed(const std::string& text) {
    const auto begin = text.find_first_not_of(' ');
    return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(' ') + 1 - begin);
  }
  std::string text_;
  std::vector<std::pair<std::string, std::string>> lines_;
};

/// A dumb-bell that drifts with velocity (1, 2).
const std::string dumb_bell = R"toml(title = "Dumb-bell"
source = "made up"
dimension = 2
body = [{ name = "a", mass = 1, position = [0, 0], velocity = [1, 2] },
        { name = "b", mass = 3, position = [2, 1], velocity = [1, 2] }]
constraint = [{ kind = "rod", between = ["a", "b"], length = "sqrt(5)" }]
)toml";

TEST(Describe, SaysWhatIsThere) {
  const Description d(dumb_bell);
  EXPECT_EQ(d.first, "test.toml: Dumb-bell");
  EXPECT_EQ(d["source"], "made up");
  EXPECT_EQ(d["space"], "2 dimensions");
  EXPECT_EQ(d["bodies"], "2, and 0 rigid");
  EXPECT_EQ(d["coordinates m"], "4");
  EXPECT_EQ(d["constraints nu"], "1");
  EXPECT_EQ(d["degrees of freedom"], "3");
  EXPECT_EQ(d["g_1"], "rod 'a'-'b'");
  EXPECT_EQ(d["Gram matrix"], "condition 1 at the start");
  EXPECT_EQ(d["effects"], "none");
  EXPECT_FALSE(d.has("effect"));
}

TEST(Describe, GivesEnergyAndMomenta) {
  const Description d(dumb_bell);
  // T = (1 + 3)/2 (1 + 4), P = 4 (1, 2), L = 3 (2 2 - 1 1)
  EXPECT_EQ(d["energy H"], "10");
  EXPECT_EQ(d["kinetic, potential"], "10, 0");
  EXPECT_EQ(d["P_x"], "4  conserved");
  EXPECT_EQ(d["P_y"], "8  conserved");
  EXPECT_EQ(d["L_z"], "9  conserved by the motion, and by k = s");
  EXPECT_FALSE(d.has("P_z"));
  EXPECT_FALSE(d.has("L_x"));
}

TEST(Describe, UniformGravityTakesWhatItBreaks) {
  const Description d(dumb_bell + "effect = [{ kind = \"uniform_gravity\", acceleration = [0, -2] }]\n");
  // U = -2 (3 1)
  EXPECT_EQ(d["kinetic, potential"], "10, 6");
  EXPECT_EQ(d["energy H"], "16");
  EXPECT_EQ(d["effect"], "uniform_gravity, 2 in all, degree 1, constant force: evaluated once");
  EXPECT_EQ(d["U"], "polynomial of degree 1: k = s conserves energy exactly");
  EXPECT_EQ(d["P_x"], "4  conserved");
  EXPECT_EQ(d["P_y"], "8");
  EXPECT_EQ(d["L_z"], "9");
}

TEST(Describe, NamesTheKThatConservesEnergy) {
  const auto springs = [](const std::string& exponent, const std::string& length) {
    return dumb_bell +
           "effect = [{ kind = \"spring\", between = [\"a\", \"b\"], stiffness = 1, exponent = " + exponent +
           ", rest_length = " + length + " }]\n";
  };
  EXPECT_EQ(Description(dumb_bell)["U"], "polynomial of degree 0: k = s conserves energy exactly");
  EXPECT_EQ(Description(springs("2", "0"))["U"], "polynomial of degree 2: k = s conserves energy exactly");
  EXPECT_EQ(Description(springs("4", "0"))["U"], "polynomial of degree 4: k >= 4/2 s conserves energy exactly");
  const Description d(springs("2", "1"));
  EXPECT_TRUE(d["U"].starts_with("not a polynomial")) << d["U"];
  EXPECT_EQ(d["effect"], "spring, 1 in all, not a polynomial");
}

TEST(Describe, CountsRigidBodies) {
  const Description d(R"(dimension = 3
body = [{ name = "a", mass = 1, position = [9, 0, 0], velocity = [0, 0, 0] }]
[[rigid_body]]
name = "top"
fixed_at = [0, 0, 0]
mass = 1
center = [0, 0, 1]
second_moment = [[1, 0, 0], [0, 1, 0], [0, 0, 2]]
directors = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
angular_velocity = [0, 0, 2]
)");
  EXPECT_EQ(d.first, "test.toml: ");
  EXPECT_FALSE(d.has("source"));
  EXPECT_EQ(d["bodies"], "1, and 1 rigid");
  EXPECT_EQ(d["coordinates m"], "12");
  EXPECT_EQ(d["constraints nu"], "6");
  EXPECT_EQ(d["degrees of freedom"], "6");
  EXPECT_EQ(d["g_1"], "directors 1 and 1 of 'top'");
  EXPECT_EQ(d["g_5"], "directors 2 and 3 of 'top'");
  // The moment of inertia about d_3 is J_11 + J_22 = 2.
  EXPECT_EQ(d["energy H"], "4");
  EXPECT_EQ(d["L_x"], "0  conserved by the motion, and by k = s");
  EXPECT_EQ(d["L_z"], "4  conserved by the motion, and by k = s");
}

TEST(Describe, WithoutConstraintsHasNoGramMatrix) {
  const Description d("dimension = 2\nbody = [{ name = \"a\", mass = 1, position = [1, 0], velocity = [0, 1] }]\n");
  EXPECT_EQ(d["constraints nu"], "0");
  EXPECT_EQ(d["degrees of freedom"], "2");
  EXPECT_FALSE(d.has("Gram matrix"));
  EXPECT_FALSE(d.has("g_1"));
}

TEST(Describe, HasAllDigitsOfThePrecision) {
  const std::string scene =
      "dimension = 2\nbody = [{ name = \"a\", mass = 2, position = [0, 0], velocity = [\"2^(1/4)\", 0] }]\n";
  for (const char* precision : {"double", "quad", "mpfr:60"}) {
    const std::string H = Description(scene, precision)["energy H"];
    const PrecisionScope scope(60);
    const Mpfr error = abs(Mpfr(literal<Mpfr>(H) - literal<Mpfr>("sqrt(2)")));
    const unsigned digits = Precision::parse(precision).digits();
    EXPECT_LT(error, pow(Mpfr(10), 1 - static_cast<int>(digits))) << H;
    if (digits < 60) {
      EXPECT_GT(error, pow(Mpfr(10), -3 - static_cast<int>(digits))) << H;
    }
  }
}

TEST(Describe, SaysOnWhomEffectsAct) {
  const Description d(dumb_bell + R"(
effect = [{ kind = "uniform_gravity", acceleration = [0, -1], on = ["b"] }, { kind = "spring", stiffness = 1 }]
)");
  EXPECT_EQ(d.all("on"), (std::vector<std::string>{"'b'", "'a'-'b'"}));
  EXPECT_EQ(d["not on"], "'a' (not named)");
}

TEST(Describe, RefusesAnEffectWithoutAValue) {
  std::string text = dumb_bell + "effect = [{ kind = \"mutual_gravity\", strength = 1 }]\n";
  text.replace(text.find("constraint ="), text.find("effect =") - text.find("constraint ="), "");
  text.replace(text.find("[2, 1]"), 6, "[0, 0]");
  EXPECT_EQ(message_of([&] { Description{text}; }),
            "test.toml:6: effect 1 (mutual_gravity) has no value at the start on 'a'-'b'");
}

TEST(Describe, ShowsMomentsOfInertia) {
  const Description d(R"(dimension = 2
effect = [{ kind = "uniform_gravity", acceleration = [0, -1] }]
[[rigid_body]]
name = "bar"
fixed_at = [0, 0]
mass = 3
center = ["1/2", 0]
second_moment = [[1, 0], [0, "1/4"]]
directors = [[1, 0], [0, 1]]
angular_velocity = 1
)");
  EXPECT_EQ(d["'bar'"], "inertia 0.5 about the centre of mass");
  EXPECT_EQ(d["on"], "'bar'");
  EXPECT_EQ(d.all("").back(), "rigid bodies at the centre of mass");
}

TEST(Describe, RefusesAnInconsistentStart) {
  std::string text = dumb_bell;
  text.replace(text.find("sqrt(5)"), 7, "sqrt(6)");
  EXPECT_THROW(Description{text}, InputError);
}

TEST(Describe, AllScenesThatAreShipped) {
  for (const auto& [name, text] : built_in_scenes()) {
    const Scene scene = read_scene(text, name);
    for (const char* precision : {"double", "quad", "mpfr:40"})
      EXPECT_TRUE(to_text(describe(scene, Precision::parse(precision))).starts_with(name + ": " + scene.title));
  }
}

}  // namespace
}  // namespace hbvm::core

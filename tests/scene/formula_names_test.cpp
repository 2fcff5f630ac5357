#include "scene/formula_names.hpp"

#include "scene/formula_scene.hpp"

namespace hbvm::core {
namespace {

std::set<std::string> names(Acts acts, int dimension, std::vector<std::string> of = {}) {
  std::set<std::string> result;
  for (const auto& [name, is] : formula_names({Expression::parse("0"), acts, std::move(of)}, dimension))
    result.insert(name);
  return result;
}

TEST(FormulaNames, AreThoseOfWhatItActsOn) {
  using Names = std::set<std::string>;
  EXPECT_EQ(names(Acts::on_each_body, 3), (Names{"x", "y", "z", "m", "Q", "t"}));
  EXPECT_EQ(names(Acts::about_a_center, 2), (Names{"x", "y", "r", "m", "Q", "t"}));
  EXPECT_EQ(names(Acts::between_pairs, 2), (Names{"x", "y", "r", "x1", "y1", "x2", "y2", "m1", "m2", "Q1", "Q2", "t"}));
  EXPECT_EQ(names(Acts::on_group, 2, {"a", "b"}), (Names{"x1", "y1", "x2", "y2", "m1", "m2", "Q1", "Q2", "a.x", "a.y",
                                                         "b.x", "b.y", "a.m", "b.m", "a.Q", "b.Q", "t"}));
}

TEST(FormulaNames, AreRefusedWithLineAndColumn) {
  EXPECT_EQ(refusal(pendulum_by_formulas), "");
  const auto refused = [](const std::string& from, const std::string& to) {
    return refusal(changed(pendulum_by_formulas, from, to));
  };
  const auto of_gravity = [&](const std::string& U) { return refused("U = \"-9.81*m*y\"", "U = " + U); };
  const std::string at = "test.toml:40: effect 1 (formula): 'U', ";
  EXPECT_EQ(of_gravity("\"-9.81*m*Y\""), at + "line 40, column 14: unknown name 'Y'");
  EXPECT_EQ(of_gravity("'''\n  -9.81*m*y\n  + sin(z)'''"), at + "line 42, column 9: unknown name 'z'");
  EXPECT_EQ(of_gravity("\"-9.81*m*\\u0079 + 2x\""), at +
                                                        "column 14 of the formula: 'x' does not fit here; a product is "
                                                        "written '-9.81*m*y + 2*x'");
  EXPECT_EQ(of_gravity("\"-9.81*m*y + k.x\""), at + "line 40, column 18: unknown name 'k.x'");
  EXPECT_EQ(of_gravity("\"-9.81*m*)\""), at + "line 40, column 14: ')' comes where a number is expected");
  EXPECT_EQ(of_gravity("\"\""), at + "line 40, column 6: the end comes where a number is expected");
  EXPECT_EQ(refused("g = \"x^2 + y^2 - 1\"", "g = \"x^2 + r\""),
            "test.toml:31: constraint 1 (formula): 'g', line 31, column 12: unknown name 'r'");
  EXPECT_EQ(refused("k = \"0.3\"", "k = \"0.3\"\nm = 2"),
            "test.toml:41: effect 1 (formula): 'U', line 41, column 12: 'm' is a constant of the scene, and something "
            "of the bodies here: rename the constant");
}

TEST(FormulaNames, OfFunctionsAreNoConstants) {
  for (const char* const name : {"tan", "sinh", "cosh", "tanh", "atan", "pi"})
    expect_words(refusal(changed(pendulum_by_formulas, "k = \"0.3\"", "k = \"0.3\"\n" + std::string(name) + " = 2")),
                 {"cannot be the name"});
}

}  // namespace
}  // namespace hbvm::core

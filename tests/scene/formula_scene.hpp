#pragma once

#include "scene/scene_text.hpp"

namespace hbvm::core {

/// The double pendulum with rods as formulas, whose digits are those of built-in ones, and a charge at its pivot.
inline const std::string pendulum_by_formulas = R"(title = "By formulas"
source = "made up"
dimension = 2

[constants]
L = "1/2"
k = "0.3"

[[point]]
name = "pivot"
position = [0, 0]
charge = 2

[[body]]
name = "a"
mass = 1
position = ["3/5", "-4/5"]
velocity = ["2/5", "3/10"]
charge = "3/7"

[[body]]
name = "b"
mass = 3
position = ["3/5", "-13/10"]
velocity = ["7/10", "3/10"]
charge = "-1/3"

[[constraint]]
kind = "formula"
on = "a"
g = "x^2 + y^2 - 1"

[[constraint]]
kind = "formula"
between = ["a", "b"]
g = "(x1 - x2)^2 + (y1 - y2)^2 - L^2"

[[effect]]
kind = "formula"
U = "-9.81*m*y"

[[effect]]
kind = "formula"
between = [["a", "b"], ["pivot", "b"]]
U = "-k*Q1*Q2/r"

[[effect]]
kind = "formula"
center = "pivot"
on = ["b"]
U = "-2/2*r^2"
)";

/// The same with what is built in.
inline const std::string pendulum_as_built_in = [] {
  std::string text = pendulum_by_formulas;
  for (const auto& [from, to] :
       {std::pair("kind = \"formula\"\non = \"a\"\ng = \"x^2 + y^2 - 1\"",
                  "kind = \"rod\"\nbetween = [\"pivot\", \"a\"]\nlength = 1"),
        {"kind = \"formula\"\nbetween = [\"a\", \"b\"]\ng = \"(x1 - x2)^2 + (y1 - y2)^2 - L^2\"",
         "kind = \"rod\"\nbetween = [\"a\", \"b\"]\nlength = \"L\""},
        {"kind = \"formula\"\nU = \"-9.81*m*y\"", "kind = \"uniform_gravity\"\nacceleration = [0, -9.81]"},
        {"kind = \"formula\"\nbetween = [[\"a\", \"b\"], [\"pivot\", \"b\"]]\nU = \"-k*Q1*Q2/r\"",
         "kind = \"coulomb\"\nbetween = [[\"a\", \"b\"], [\"pivot\", \"b\"]]\nstrength = \"k\""},
        {"kind = \"formula\"\ncenter = \"pivot\"\non = [\"b\"]\nU = \"-2/2*r^2\"",
         "kind = \"trap\"\ncenter = \"pivot\"\non = [\"b\"]\nstiffness = 2\nexponent = 2"}})
    text = changed(text, from, to);
  return text;
}();

}  // namespace hbvm::core

#pragma once

#include <string>
#include <string_view>

#include "scalar/literal.hpp"
#include "scene/scene.hpp"
#include "words.hpp"

namespace hbvm::core {

/// A consistent scene in space with every kind of table, every constraint and every effect.
inline const std::string every_key = R"(title = "Every key"
source = "made up"
dimension = 3

[constants]
L = "1/2"
unit = "2*L"

[[point]]
name = "pivot"
position = [0, 0, 0]

[[point]]
name = "charge"
position = [2, "L", 0.25]
charge = -1

[[body]]
name = "a"
mass = 2
position = ["3/5", 0, -0.8]
velocity = [0.4, 0, "3/10"]
charge = "3/2"

[[body]]
name = "b"
mass = [[2, "1/4", 0], [0.25, 1, 0], [0, 0, 1]]
position = [1, 1, 1]
momentum = ["87/16", -1.5, 1.125]

[[body]]
name = "c"
mass = "unit"
position = [1, 1, 0]
velocity = [2, -1, 0]

[[rigid_body]]
name = "top"
fixed_at = [0, 1, "L"]
mass = 3
center = [0.1, "1/5", 1]
second_moment = [[2, "1/4", "1/5"], ["1/4", "3/2", "-1/3"], ["1/5", "-1/3", 4]]
directors = [["2/3", "2/3", "1/3"], ["-2/3", "1/3", "2/3"], ["1/3", "-2/3", "2/3"]]
angular_velocity = ["1/2", 1, "-1/2"]

[[rigid_body]]
name = "stone"
position = [5, 6, 7]
velocity = [1, -1, "1/3"]
mass = 4
center = [0, "1/8", 0]
second_moment = [[1, 0, 0], [0, 2, 0.5], [0, 0.5, 3]]
directors = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
angular_velocity = [2, 3, 5]

[[constraint]]
kind = "rod"
between = ["pivot", "a"]
length = "unit"

[[constraint]]
kind = "quadric"
body = "b"
A = [[1, 0.25, 0], ["1/4", 2, 0], [0, 0, 1]]
b = ["L", 0, -1]
c = -4

[[constraint]]
kind = "plane"
body = "c"
normal = [1, 2, 2]
offset = 3

[[constraint]]
kind = "angle"
first = ["a", "pivot"]
second = ["c", "b"]
value = 0.8

[[effect]]
kind = "uniform_gravity"
acceleration = [0, "-1/7", -1]

[[effect]]
kind = "central_gravity"
center = "pivot"
strength = 0.3
on = ["a", "c"]

[[effect]]
kind = "mutual_gravity"
strength = "1/5"
between = ["a", "c"]

[[effect]]
kind = "coulomb"
strength = 0.7

[[effect]]
kind = "spring"
between = [["a", "b"], ["c", "charge"]]
stiffness = 1.25
rest_length = "1/3"
exponent = 4

[[effect]]
kind = "spring"
between = ["b", "c"]
stiffness = 2

[[effect]]
kind = "trap"
center = "charge"
stiffness = "L/10"
exponent = 4

[[effect]]
kind = "lennard_jones"
depth = 0.01
diameter = "9/10"
between = ["a", "b"]

[[effect]]
kind = "radial_cosine"
center = "charge"
strength = 0.5

[[effect]]
kind = "oblateness"
center = "charge"
strength = 1.5
radius = "1/2"
J2 = 1.08e-3
axis = [1, 2, 2]
on = ["a"]
)";

/// `text` with its only occurrence of `from` replaced.
inline std::string changed(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  EXPECT_EQ(text.find(from, at + 1), std::string::npos) << from << " stands more than once";
  return text.replace(at, from.size(), to);
}

/// The constraint that keeps two bodies or points at a length.
inline std::string rod(const std::string& a, const std::string& b, const std::string& length) {
  return "[[constraint]]\nkind = \"rod\"\nbetween = [\"" + a + "\", \"" + b + "\"]\nlength = " + length + "\n";
}

/// A chain of n links of length 1 along (3/5, y) from a fixed point.
inline std::string chain(int n, const std::string& y) {
  std::string text = "dimension = 2\n[[point]]\nname = \"0\"\nposition = [0, 0]\n", rods;
  for (int i = 1; i <= n; ++i) {
    const std::string name = std::to_string(i);
    text += "[[body]]\nname = \"" + name + "\"\nmass = 1\nposition = [\"" + name + "*3/5\", \"" + name + "*" + y +
            "\"]\nvelocity = [0, 0]\n";
    rods += rod(std::to_string(i - 1), name, "1");
  }
  return text + rods;
}

/// The line, from 1, on which `part` first stands.
inline std::size_t line_of(std::string_view text, std::string_view part) {
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string_view::npos) << part;
  std::size_t line = 1;
  for (const char c : text.substr(0, at)) line += c == '\n';
  return line;
}

/// The one line that wrong input is refused with; empty if it is not.
std::string refused(const auto& use) {
  std::string message;
  try {
    use();
  } catch (const InputError& error) {
    message = error.what();
  }
  EXPECT_EQ(message.find('\n'), std::string::npos) << "more than one line: " << message;
  return message;
}

/// What read_scene refuses the text with; empty if it does not.
inline std::string refusal(const std::string& text) {
  return refused([&] { read_scene(text, "test.toml"); });
}

/// The number of a scene with 50 digits.
inline Mpfr value(const Expression& e, const Scene& scene) { return evaluate<Mpfr>(e, scene.constants); }

}  // namespace hbvm::core

#pragma once

#include <string>

namespace hbvm::core {

/// A consistent scene in space of rigid bodies joined in every way. It has base, arm, bob by a hinge and a ball joint,
/// and a bead. They are attached to rods, angles, springs, charges and traps, by names and in place.
inline const std::string joined_bodies = R"toml(title = "Joined bodies"
source = "made up"
dimension = 3

[[point]]
name = "hook"
position = [3, 3, -1]
charge = 2

[[body]]
name = "bead"
mass = 1
position = [0, 5, 0]
velocity = [0, 0, 0]
charge = 3

[[rigid_body]]
name = "base"
position = [0, 0, 0]
velocity = [1, 0, 0]
mass = 2
center = [0, 0, "1/10"]
second_moment = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
directors = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
angular_velocity = [0, 0, 1]

[[rigid_body]]
name = "arm"
position = ["3/2", 0, 0]
velocity = [1, "5/2", 0]
mass = 1
center = [0, 0, 0]
second_moment = [["1/10", 0, 0], [0, "1/5", 0], [0, 0, "1/10"]]
directors = [[0, 0, 1], [1, 0, 0], [0, 1, 0]]
angular_velocity = [0, 0, 3]

[[rigid_body]]
name = "bob"
position = [2, 0, 0]
velocity = [1, 4, 0]
mass = 3
center = ["1/10", "1/5", 0]
second_moment = [[2, 0, 0], [0, 2, 0], [0, 0, 2]]
directors = [["2/3", "2/3", "1/3"], ["-2/3", "1/3", "2/3"], ["1/3", "-2/3", "2/3"]]
angular_velocity = [1, 2, -1]

[[attachment]]
name = "left"
of = "bob"
at = [3, 0, 0]
charge = "1/2"

[[attachment]]
name = "right"
of = "bob"
at = [0, -1, "1/4"]
charge = -1

[[constraint]]
kind = "hinge"
between = [{ of = "base", at = [1, 0, 0] }, { of = "arm", at = [0, "-1/2", 0] }]
axis = [0, 0, 2]
second_axis = [-3, 0, 0]

[[constraint]]
kind = "ball_joint"
between = [{ of = "arm", at = [0, "1/2", 0] }, { of = "bob", at = [0, 0, 0] }]

[[constraint]]
kind = "rod"
between = ["left", "hook"]
length = "sqrt(6)"

[[constraint]]
kind = "angle"
first = [{ of = "arm", at = [1, 0, 0] }, { of = "arm", at = [0, 0, 0] }]
second = [{ of = "bob", at = [2, 0, -1] }, { of = "bob", at = [0, 0, 0] }]
value = 0

[[effect]]
kind = "uniform_gravity"
acceleration = [0, "1/2", -1]
on = ["arm", "bob"]

[[effect]]
kind = "coulomb"
strength = 0.7

[[effect]]
kind = "spring"
between = [["bead", "right"], [{ of = "base", at = [0, 2, 0] }, "left"]]
stiffness = 2
rest_length = "1/2"

[[effect]]
kind = "trap"
center = "hook"
stiffness = 3
exponent = 2
on = ["bead", { of = "arm", at = ["1/3", 0, 1] }]
)toml";

}  // namespace hbvm::core

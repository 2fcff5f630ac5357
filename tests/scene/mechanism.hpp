#pragma once

#include <array>
#include <string>
#include <vector>

namespace hbvm::core {

/// A consistent scene in space of five rigid bodies, each joined to the next in another way.
inline const std::string mechanism = R"toml(title = "Mechanism"
source = "made up"
dimension = 3

[[point]]
name = "post"
position = [0, 0, 0]

[[rigid_body]]
name = "base"
position = [0, 0, 0]
velocity = [0, 0, 0]
mass = 2
center = [0, 0, "1/10"]
inertia = [1, 1, 1]
orientation = { axis = [1, 0, 0], angle = 0 }
angular_velocity = [0, 0, 0]

[[rigid_body]]
name = "slider"
position = [2, 0, 0]
velocity = [1, 0, 0]
mass = 1
center = [0, 0, 0]
inertia = [1, 2, 2]
orientation = { axis = [1, 2, 2], angle = "pi/3" }
angular_velocity = [0, 0, 0]

[[rigid_body]]
name = "plate"
position = [2, 1, 0]
velocity = [1, 0, 0]
mass = 1
center = ["1/4", 0, 0]
inertia = [1, 1, "3/2"]
orientation = { directors = [[0, 1, 0], [-1, 0, 0], [0, 0, 1]] }
angular_velocity = [0, 0, 0]

[[rigid_body]]
name = "fork"
position = [2, 1, 1]
velocity = [1, 0, 0]
mass = 1
center = [0, 0, "1/2"]
inertia = [1, 1, 1]
orientation = { axis = [1, 0, 0], angle = 0 }
angular_velocity = [0, 0, 0]

[[rigid_body]]
name = "shaft"
position = [2, 1, 4]
velocity = [1, 0, "1/2"]
mass = 1
center = [0, 0, 0]
inertia = [1, 1, "1/2"]
orientation = { axis = [0, 0, 1], angle = 2 }
angular_velocity = [0, 0, 3]

[[attachment]]
name = "corner"
of = "slider"
at = ["1/9 + 1/sqrt(3)", "13/18", "2/9 - 1/(2*sqrt(3))"]

[[constraint]]
kind = "prismatic"
between = [{ of = "base", at = [0, 0, 0] }, { of = "slider", at = [0, 0, 0] }]
axis = [3, 0, 0]

[[constraint]]
kind = "weld"
between = ["corner", { of = "plate", at = [0, 0, 0] }]

[[constraint]]
kind = "universal"
between = [{ of = "plate", at = [0, 0, 1] }, { of = "fork", at = [0, 0, 0] }]
axis = [0, 2, 0]
second_axis = [0, 1, 0]

[[constraint]]
kind = "cylindrical"
between = [{ of = "fork", at = [0, 0, 1] }, { of = "shaft", at = [0, 0, 0] }]
axis = [0, 0, 1]
second_axis = [0, 0, -2]
)toml";

/// What may act on it: a weight of (3, -10, 1) times the mass, and a spring of stiffness 2 on the shaft.
inline const std::string mechanism_effects = R"toml([[effect]]
kind = "uniform_gravity"
acceleration = [3, -10, 1]

[[effect]]
kind = "spring"
stiffness = 2
between = ["post", { of = "shaft", at = [0, 0, 0] }]
)toml";

/// The joint of each body to the next, by the places that it is between.
inline const std::vector<std::array<std::string, 2>> mechanism_joints{{"base[0, 0, 0]", "slider[0, 0, 0]"},
                                                                      {"corner", "plate[0, 0, 0]"},
                                                                      {"plate[0, 0, 1]", "fork[0, 0, 0]"},
                                                                      {"fork[0, 0, 1]", "shaft[0, 0, 0]"}};

/// Name, mass, and the centre of mass in the frame of each body.
inline const std::vector<std::array<std::string, 5>> mechanism_bodies{{"base", "2", "0", "0", "1/10"},
                                                                      {"slider", "1", "0", "0", "0"},
                                                                      {"plate", "1", "1/4", "0", "0"},
                                                                      {"fork", "1", "0", "0", "1/2"},
                                                                      {"shaft", "1", "0", "0", "0"}};

}  // namespace hbvm::core

#pragma once

#include "problem/driven_course.hpp"
#include "scalar/literal.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {

/// Two bodies with dampers, drag, forces by formulas and a field that depends on t. One of them hangs on a point that
/// moves.
inline const Scene& scene_with_work() {
  static const Scene scene = read_scene(R"toml(title = "Work"
dimension = 2
[[point]]
name = "hand"
position = ["sin(3*t)", "t^2/4"]
[[body]]
name = "a"
mass = [[2, "1/3"], ["1/3", 1]]
position = [1, "1/2"]
velocity = ["1/3", -1]
[[body]]
name = "b"
mass = 3
position = [-1, 2]
velocity = [2, "1/5"]
[[effect]]
kind = "spring"
between = ["hand", "a"]
stiffness = 2
rest_length = "1/2"
damping = "1/3"
[[effect]]
kind = "damper"
between = ["a", "b"]
coefficient = "3/4"
[[effect]]
kind = "drag"
on = ["b"]
linear = "1/5"
quadratic = "1/7"
[[effect]]
kind = "formula"
U = "-(1 + t)*x^2*y"
[[effect]]
kind = "force"
on = ["a"]
F = ["x*vy + t", "sin(vx)/(1 + y^2)"]
[[effect]]
kind = "force"
of = ["a", "b"]
F = ["b.x - a.x", "0", "a.x - b.x", "t*b.vy"]
)toml",
                                        "work");
  return scene;
}

/// The scene at t, with the driven coordinates where they are then.
template <Scalar S>
Vector<S> placed_at(const Problem<S>& problem, Vector<S> q, const S& t) {
  DrivenCourse<S> course(problem, 1);
  course.time(0) = t;
  course.evaluate();
  course.set_positions(lanes(q));
  return q;
}

}  // namespace hbvm::core

#pragma once

#include "reference/closed_form/against_taylor.hpp"

namespace hbvm::core {

/// A rigid body with moments of inertia J about its centre of mass in the body frame, as directors that stand
/// obliquely.
struct RigidScene {
  std::string fixed = "", position = "[1, \"-1/3\", 2]", velocity = "[\"1/2\", \"1/4\", -1]", mass = "2",
              center = "[0, 0, 0]", second_moment = "[[\"1/2\", 0, 0], [0, \"1/3\", 0], [0, 0, \"1/4\"]]",
              directors =
                  "[[\"4/9\", \"4/9\", \"7/9\"], [\"1/9\", \"-8/9\", \"4/9\"], [\"8/9\", \"-1/9\", "
                  "\"-4/9\"]]",
              omega = "[\"1/3\", -2, 1]", more = "";

  std::string text() const {
    return "dimension = 3\n[[rigid_body]]\nname = \"body\"\n" +
           (fixed.empty() ? "position = " + position + "\nvelocity = " + velocity : "fixed_at = " + fixed) +
           "\nmass = " + mass + "\ncenter = " + center + "\nsecond_moment = " + second_moment +
           "\ndirectors = " + directors + "\nangular_velocity = " + omega + "\n" + more;
  }
};

/// Points that turn with the angular velocity (u, v, w) about (1, 2, 3), all of whose distances are fixed.
inline std::string cluster(const std::vector<std::array<std::string, 3>>& points, const std::string& drift,
                           const std::string& pin = "", const std::string& more = "") {
  std::string text = "dimension = 3\n[constants]\nu = \"1/2\"\nv = \"-4/3\"\nw = \"3/4\"\nd = \"" + drift + "\"\n" +
                     point("o", "[1, 2, 3]");
  const auto place = [](const std::string& x, const char* origin) { return "\"" + x + " + " + origin + "\""; };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& [x, y, z] = points[i];
    text += body("b" + std::to_string(i), "\"" + std::to_string(2 * i + 1) + "/3\"",
                 "[" + place(x, "1") + ", " + place(y, "2") + ", " + place(z, "3") + "]",
                 "[\"v*(" + z + ") - w*(" + y + ") + d\", \"w*(" + x + ") - u*(" + z + ") - d\", \"u*(" + y +
                     ") - v*(" + x + ")\"]");
  }
  const auto add_rod = [&](std::size_t i, const std::string& b, const std::array<std::string, 3>& q) {
    const auto& [x, y, z] = points[i];
    text += rod("b" + std::to_string(i), b,
                "\"sqrt((" + x + "-(" + q[0] + "))^2+(" + y + "-(" + q[1] + "))^2+(" + z + "-(" + q[2] + "))^2)\"");
  };
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) add_rod(i, "b" + std::to_string(j), points[j]);
  if (!pin.empty())
    for (std::size_t i = 0; i < points.size(); ++i) add_rod(i, pin, {"0", "0", "0"});
  return text + more;
}

inline const std::vector<std::array<std::string, 3>> triangle{
    {"1", "0", "1/3"}, {"-2/3", "1/2", "0"}, {"0", "-1", "1/7"}},
    tetrahedron{{"1", "0", "0"}, {"-2/3", "1/2", "0"}, {"0", "-1", "1/7"}, {"1/5", "1/3", "1"}};

}  // namespace hbvm::core

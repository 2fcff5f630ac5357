#include "reference/closed_form/rigid_scenes.hpp"

namespace hbvm::core {
namespace {

constexpr const char* body_name = "free rigid body";
const std::string falling = field("[1, -3, \"1/2\"]");

/// About any axis: on either side of the separatrix, and in either sense.
TEST(FreeRigidBody, TumblesAsTaylorSeriesDo) {
  for (const char* omega : {"[\"1/3\", -2, 1]", "[2, 1, \"1/2\"]", "[\"-1/10\", \"-1/5\", \"3/2\"]", "[0, 1, 0]",
                            "[-2, \"1/9\", \"-7/5\"]", "[\"8/9\", \"-1/9\", \"4/9\"]"}) {
    RigidScene scene;
    scene.omega = omega;
    expect_follows_taylor(scene.text(), body_name, {"1/3", "20"}, 40, 10);
  }
}

/// Directors 4/9 4/9 7/9, ... are the principal axes: about each of them, exactly and nearly.
TEST(FreeRigidBody, TurnsAboutItsPrincipalAxes) {
  RigidScene scene;
  for (const char* omega : {"[\"4/3\", \"4/3\", \"7/3\"]", "[\"1/9\", \"-8/9\", \"4/9\"]",
                            "[\"8/9\", \"-1/9\", \"-4/9\"]", "[\"-8/9\", \"1/9\", \"4/9\"]"}) {
    scene.omega = omega;
    expect_follows_taylor(scene.text(), body_name, {"1/3", "10"}, 50, 16);
  }
  // Beside them the motion about the middle axis is unstable.
  for (const char* off : {"1e-25", "1e-12", "1e-4"})
    for (const std::string axis : {"\"8/9 + x\", \"-1/9\", \"-4/9\"", "\"1/9 + x\", \"-8/9\", \"4/9 - x\"",
                                   "\"4/9 + x\", \"4/9 + x\", \"7/9\""}) {
      scene.omega = "[" + axis + "]";
      std::string text = scene.text();
      text.insert(text.find('\n') + 1, "[constants]\nx = \"" + std::string(off) + "\"\n");
      expect_follows_taylor(text, body_name, {"1/3", "10"}, 50, 16);
    }
}

/// Directors that are the axes, and a body that turns about one of them. It turns about the middle one, where the
/// modulus is 1, and beside it by less than any digit.
TEST(FreeRigidBody, TurnsSteadilyAboutEachAxis) {
  RigidScene scene;
  scene.directors = "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]";
  for (const unsigned digits : {15U, 40U}) {
    for (const char* omega : {"[0, 5, 0]", "[5, 0, 0]", "[0, 0, -5]", "[0, 0, 0]"}) {
      scene.omega = omega;
      expect_follows_taylor(scene.text(), "uniform rotation", {"1/3", "2"}, digits, 8);
    }
    for (const char* omega :
         {"[\"1e-20\", 5, 0]", "[0, 5, \"1e-40\"]", "[\"1e-400\", 5, 0]", "[\"1e-12\", -5, \"1e-300\"]",
          "[5, \"1e-200\", 0]", "[\"1e-90\", 0, 5]", "[\"1e-9\", \"1e-50\", \"1e-90\"]"}) {
      scene.omega = omega;
      expect_follows_taylor(scene.text(), body_name, {"1/3", "2"}, digits, 10);
    }
  }
}

/// A symmetric body whose axis stands anyhow among the directors tumbles end over end; and turns about it.
TEST(FreeRigidBody, TumblesEndOverEnd) {
  RigidScene scene;
  scene.directors = "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]";
  for (const char* moments : {"[[1, 0, 0], [0, 1, 0], [0, 0, 2]]", "[[2, 0, 0], [0, 1, 0], [0, 0, 1]]",
                              "[[1, 0, 0], [0, 2, 0], [0, 0, 1]]", "[[2, 0, 0], [0, 2, 0], [0, 0, 1]]",
                              "[[1, 0, 0], [0, 2, 0], [0, 0, 2]]", "[[2, 0, 0], [0, 1, 0], [0, 0, 2]]"}) {
    scene.second_moment = moments;
    for (const char* omega : {"[1, 0, 0]", "[0, 1, 0]", "[0, 0, 1]"}) {
      scene.omega = omega;
      expect_follows_taylor(scene.text(), "uniform rotation", {"3"}, 30, 8);
    }
    for (const char* omega : {"[1, 1, 0]", "[1, 0, 1]", "[0, -1, 1]"}) {
      scene.omega = omega;
      expect_follows_taylor(scene.text(), "", {"3"}, 30, 8);
    }
  }
}

/// Two moments equal, of the greater or the less; turning across the axis of symmetry and obliquely; and all three.
TEST(FreeRigidBody, OfSymmetricBodies) {
  for (const char* moments :
       {"[[\"1/2\", 0, 0], [0, \"1/2\", 0], [0, 0, \"1/4\"]]", "[[\"1/2\", 0, 0], [0, \"1/4\", 0], [0, 0, \"1/4\"]]",
        "[[\"1/5\", 0, 0], [0, \"1/5\", 0], [0, 0, \"1/5\"]]"})
    for (const char* omega : {"[\"1/3\", -2, 1]", "[\"4/9\", \"4/9\", \"7/9\"]", "[\"1/9\", \"-8/9\", \"4/9\"]",
                              "[\"8/9\", \"-1/9\", \"-4/9\"]", "[\"5/9\", \"-4/9\", \"11/9\"]"}) {
      RigidScene scene;
      scene.second_moment = moments;
      scene.omega = omega;
      const bool sphere = std::string(moments).find("1/5") != std::string::npos;
      expect_follows_taylor(scene.text(), sphere ? "uniform rotation" : body_name, {"1/3", "10"}, 40, 10);
    }
}

TEST(FreeRigidBody, OfPointsAndRods) {
  // The third is held at a point, and the last falls.
  for (const std::string& scene : {cluster(triangle, "1/7"), cluster(tetrahedron, "1/7"), cluster(triangle, "0", "o"),
                                   cluster(tetrahedron, "1/7", "", falling)})
    expect_follows_taylor(scene, body_name, {"1/3", "20"}, 40, 10);
}

/// A body whose centre of mass is not its origin, held at a point or not.
std::string off_centre(const std::string& fixed, const std::string& more) {
  RigidScene scene;
  scene.fixed = fixed;
  scene.center = "[\"1/5\", \"-1/10\", \"1/10\"]";
  scene.second_moment =
      "[[\"29/50\", \"-1/25\", \"1/25\"], [\"-1/25\", \"53/150\", \"-1/50\"], [\"1/25\", \"-1/50\", \"27/100\"]]";
  scene.more = more;
  return scene.text();
}

TEST(FreeRigidBody, AwayFromItsCentreAndFallingAndHeld) {
  for (const std::string& scene : {off_centre("", ""), off_centre("", falling), off_centre("[1, 2, 3]", "")})
    expect_follows_taylor(scene, body_name, {"1/3", "20"}, 40, 10);
}

TEST(FreeRigidBody, NothingElseMayAct) {
  expect_unknown(off_centre("[1, 2, 3]", falling));
  expect_unknown(
      cluster(tetrahedron, "1/7", "", effect("spring", "between = [[\"b0\", \"o\"]]\nstiffness = \"1e-12\"")));
  // A field on one of them, and one body more.
  expect_unknown(cluster(triangle, "1/7", "", falling + "on = [\"b1\"]\n"));
  expect_unknown(cluster(triangle, "1/7", "", body("other", "1", "[9, 9, 9]", "[0, 0, 0]")));
}

TEST(FreeRigidBody, HasAThousandDigits) {
  const RigidScene scene;
  expect_solves_equations(scene.text(), {"10"}, 1000);
}

}  // namespace
}  // namespace hbvm::core

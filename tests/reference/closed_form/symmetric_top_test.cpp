#include "reference/closed_form/rigid_scenes.hpp"

namespace hbvm::core {
namespace {

constexpr const char* top_name = "symmetric heavy top";

RigidScene top(const std::string& omega, const std::string& acceleration, const std::string& height = "3/4") {
  RigidScene scene;
  scene.fixed = "[1, 2, 3]";
  scene.center = "[0, 0, \"" + height + "\"]";
  scene.second_moment = "[[\"1/3\", 0, 0], [0, \"1/3\", 0], [0, 0, \"13/5\"]]";
  scene.omega = omega;
  scene.more = field(acceleration);
  return scene;
}

/// Slow and fast, hanging and standing, in fields of any direction.
TEST(SymmetricTop, PrecessesAsTaylorSeriesDo) {
  for (const char* acceleration : {"[0, 0, -1]", "[1, \"1/3\", 2]", "[0, 20, \"1/9\"]"})
    for (const char* omega : {"[1, \"3/2\", 3]", "[\"1/9\", 0, 0]", "[-8, 1, 5]"})
      for (const char* height : {"3/4", "-1/2"})
        expect_follows_taylor(top(omega, acceleration, height).text(), top_name, {"1/3", "10"}, 40, 11);
}

/// Moments of a disk and of a rod, and three equal ones: then every axis is one of symmetry.
TEST(SymmetricTop, OfAnyMoments) {
  RigidScene scene = top("[1, \"3/2\", 3]", "[\"1/7\", 0, -3]");
  for (const auto& [center, second_moment] :
       {std::pair("[0, 0, \"3/4\"]", "[[\"2\", 0, 0], [0, \"2\", 0], [0, 0, \"6/5\"]]"),
        {"[0, \"1/5\", 0]", "[[1, 0, 0], [0, 3, 0], [0, 0, 1]]"},
        {"[\"1/5\", \"1/6\", \"1/7\"]", "[[3, 0, 0], [0, 3, 0], [0, 0, 3]]"}}) {
    scene.center = center;
    scene.second_moment = second_moment;
    expect_follows_taylor(scene.text(), top_name, {"1/3", "10"}, 40, 11);
  }
}

TEST(SymmetricTop, TurnsForALongTime) {
  expect_follows_taylor(top("[1, \"3/2\", 3]", "[\"1/7\", 0, -3]").text(), top_name, {"100"}, 40, 12);
}

TEST(SymmetricTop, NothingElseMayAct) {
  RigidScene scene = top("[1, \"3/2\", 3]", "[0, 0, -1]");
  scene.second_moment = "[[\"1/3\", 0, 0], [0, \"1/3 + 1e-20\", 0], [0, 0, \"13/5\"]]";
  expect_unknown(scene.text());
  scene = top("[1, \"3/2\", 3]", "[0, 0, -1]");
  scene.center = "[\"1e-20\", 0, \"3/4\"]";
  expect_unknown(scene.text());
  scene = top("[1, \"3/2\", 3]", "[0, 0, -1]");
  scene.fixed = "";
  expect_follows_taylor(scene.text(), "free rigid body", {"1"}, 40, 10);
  // It starts upright: (8, -1, -4)/9 is its axis.
  expect_unknown(top("[1, \"3/2\", 3]", "[-8, 1, 4]").text());
}

TEST(SymmetricTop, HasManyDigits) {
  expect_solves_equations(top("[1, \"3/2\", 3]", "[\"1/7\", 0, -3]").text(), {"10"}, 300);
}

}  // namespace
}  // namespace hbvm::core

#include <gtest/gtest.h>

#include "hbvm/error.hpp"
#include "hbvm/run.hpp"
#include "hbvm/scene.hpp"
#include "words.hpp"

namespace hbvm {
namespace {

Scene built() {
  Scene scene(2, "built");
  scene.title("A pendulum, \"built\"").constant("L", "5/5").point("pivot", {0, 0});
  scene.body({.name = "bob", .mass = 2.5, .position = {"3*L/5", "-4/5"}}).rod("pivot", "bob", "L");
  scene.effect({.kind = "uniform_gravity", .vectors = {{"acceleration", {0, -1}}}}).observe("energy");
  return scene;
}

double end_of(const Scene& scene) {
  return std::stod(run({.scene = scene, .method = "hbvm:3,3", .step = "1/32", .until = 1}).q.front());
}

TEST(DoorScene, CanBeBuilt) {
  const Scene scene = built();
  scene.check();
  const hbvm::Run made = run({.scene = scene, .method = "hbvm:3,3", .step = "1/32", .until = 1});
  EXPECT_EQ(made.title, "A pendulum, \"built\"");
  EXPECT_EQ(made.observables.size(), 1u);
  // The same as a file.
  const Scene again = read_scene(scene.toml(), "again");
  EXPECT_EQ(end_of(again), std::stod(made.q.front()));
}

/// The mass of a lone pendulum does nothing; a spring does.
TEST(DoorScene, CanBeAddedToOnceItWasRead) {
  Scene scene = read_scene(built().toml());
  const double alone = end_of(scene);
  scene.constant("k", "1/2");
  scene.effect({.kind = "spring",
                .numbers = {{"stiffness", "k"}, {"rest_length", 0}, {"exponent", 2}},
                .between = {{"bob", "far"}}});
  scene.point("far", {2, 0});
  EXPECT_GT(end_of(scene), alone + 0.01);
  Scene shipped = load_scene("double_pendulum");
  EXPECT_EQ(shipped.name(), "double_pendulum");
  shipped.title("another").observe("angular_momentum").check();
  core::expect_words(shipped.toml(), {"title = \"another\""});
}

TEST(DoorScene, TakesFormulas) {
  Scene scene(3);
  scene.title("A bead on a sphere");
  scene.body({.name = "bead", .position = {"3/5", 0, "-4/5"}, .velocity = {0, "1/2", 0}});
  scene.constraint({.kind = "formula", .names = {{"on", {"bead"}}}, .g = "x^2 + y^2 + z^2 - 1"});
  scene.effect({.kind = "formula", .U = "-z"});
  const hbvm::Run made =
      run({.scene = scene, .method = "hbvm:4,2", .step = "1/32", .until = 1, .precision = "mpfr:30"});
  EXPECT_LT(std::stod(made.e_g), 1e-25);
}

TEST(DoorScene, BuildsEveryPart) {
  // What it takes to say the shipped scenes of rigid bodies and pairs.
  Scene scene(2);
  scene.title("parts").point("o", {0, 0}, 1);
  scene.body({.name = "a", .position = {1, 0}, .momentum = {0, 1}, .charge = "1/2"});
  scene.body({.name = "b", .position = {0, 2}, .mass_matrix = {{2, 0}, {0, 3}}});
  scene.rigid_body({.name = "bar",
                    .mass = 1,
                    .position = {3, 0},
                    .center = {"1/2", 0},
                    .second_moment = {{"1/3", 0}, {0, "1/100"}},
                    .directors = {{1, 0}, {0, 1}},
                    .angular_velocity = {"1/10"}});
  scene.attachment("tip", "bar", {1, 0});
  scene.effect({.kind = "coulomb", .numbers = {{"strength", "1/10"}}, .between = {{"a", "o"}}});
  scene.effect({.kind = "formula", .center = "o", .on = {"b", "tip"}, .U = "-r^2/2"});
  scene.check();
  EXPECT_GT(run({.scene = scene, .method = "hbvm:4,2", .step = "1/32", .until = "1/4"}).steps, 7);
}

TEST(DoorScene, SaysWhatIsWrong) {
  EXPECT_THROW(Scene(4), InputError);
  Scene scene = built();
  scene.rod("bob", "nobody", 1);
  core::expect_words(core::message_of([&] { scene.check(); }), {"nobody"});
  EXPECT_THROW(load_scene("no_such_scene"), InputError);
  EXPECT_THROW(read_scene("dimension = "), InputError);
  // What only the numbers show.
  const auto refusal = [](const Body& body) { return core::message_of([&] { Scene(2).body(body).check(); }); };
  core::expect_words(refusal({.name = "a", .mass = -1, .position = {0, 0}}), {"'a'", "mass must be positive"});
}

/// A body by its inertia and orientation, and the same by its second moment and directors.
TEST(DoorScene, BuildsRigidBodiesByInertiaAndOrientation) {
  Scene by_angle(2, "bar"), by_directors(2, "bar");
  RigidBody bar{.name = "bar", .mass = 2, .position = {0, 0}, .fixed = true, .center = {1, 0}, .angular_velocity = {1}};
  bar.inertia = {{"2/3"}};
  bar.orientation = Orientation{.angle = "pi/2"};
  by_angle.rigid_body(bar);
  bar.inertia.clear();
  bar.orientation.reset();
  bar.second_moment = {{"7/3", 0}, {0, "1/3"}};
  bar.directors = {{0, 1}, {-1, 0}};
  by_directors.rigid_body(bar);
  const auto turned = [](const Scene& scene) {
    return run({.scene = scene, .method = "rattle", .step = 1, .until = 1});
  };
  EXPECT_EQ(turned(by_angle).q, turned(by_directors).q);
  Scene top(3, "top");
  RigidBody disc{
      .name = "disc", .position = {0, 0, 0}, .fixed = true, .center = {0, 0, 1}, .angular_velocity = {0, 0, 9}};
  disc.inertia = {{1, 1, "3/2"}};
  for (const Orientation& orientation :
       {Orientation{.quaternion = {1, 2, 3, 4}}, Orientation{.angle = 1, .axis = {1, 2, 3}},
        Orientation{.euler = {1, 2, 3}, .sequence = "zxz"}}) {
    disc.orientation = orientation;
    EXPECT_NO_THROW(Scene(top).rigid_body(disc).check());
  }
}

TEST(DoorScene, IsMadeConsistent) {
  Scene scene(2);
  scene.point("o", {0, 0}).body({.name = "a", .position = {"0.6", "0.7"}, .velocity = {2, 0}}).rod("o", "a", 1);
  EXPECT_THROW(scene.check(), InputError);
  EXPECT_NO_THROW(project(scene, "mpfr:60").check());
  const std::string held = project(scene, "double", {"a.x", "a.vx"}).toml();
  EXPECT_NE(held.find("[\"0.6\", \"0.8"), std::string::npos) << held;
  EXPECT_THROW(project(scene, "double", {"b.x"}), InputError);
}

TEST(DoorScene, BeginsWithATemplate) { EXPECT_NO_THROW(read_scene(scene_template()).check()); }

TEST(DoorScene, BuildsShapes) {
  for (const Shape& shape : {Shape{"box", {1, 2, 3}}, Shape{.kind = "cylinder", .size = {1, 2}, .axis = {0, 1, 0}},
                             Shape{.kind = "sphere", .size = {"1/2"}, .at = {0, 0, 1}}}) {
    Scene scene(3);
    scene.rigid_body({.name = "a",
                      .position = {0, 0, 0},
                      .orientation = Orientation{.angle = 0, .axis = {0, 0, 1}},
                      .inertia = {{1, 1, 1}},
                      .angular_velocity = {0, 0, 1},
                      .shape = shape});
    EXPECT_NO_THROW(scene.check());
    EXPECT_NE(scene.toml().find(shape.kind + " = "), std::string::npos) << scene.toml();
  }
}

/// Of a scene that was read and of one that is built; the command makes the same again.
TEST(DoorScene, TakesOtherNumbers) {
  Scene scene = load_scene("double_pendulum");
  scene.set("a.mass", "7/3");
  const hbvm::Run changed = run({.scene = scene, .method = "rattle", .step = "1/32", .until = 1});
  EXPECT_NE(changed.q, run({.scene = load_scene("double_pendulum"), .method = "rattle", .step = "1/32", .until = 1}).q);
  EXPECT_NE(changed.command.find("double_pendulum --set 'a.mass=7/3' --method"), std::string::npos) << changed.command;
  Scene built(2, "built");
  built.constant("m", 1).point("o", {0, 0}).body({.name = "a", .mass = "m", .position = {1, 0}}).rod("o", "a", 1);
  built.set("m", 3).observe("energy");
  EXPECT_NE(built.toml().find("m = \"3\""), std::string::npos) << built.toml();
  EXPECT_EQ(run({.scene = built, .method = "rattle", .step = "1/4", .until = 1}).steps, 4);
  EXPECT_THROW(scene.set("c.mass", 1), InputError);
}

}  // namespace
}  // namespace hbvm

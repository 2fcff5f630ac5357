#include <gtest/gtest.h>

#include <cmath>

#include "door/run_of.hpp"
#include "hbvm/error.hpp"
#include "hbvm/run.hpp"
#include "words.hpp"

namespace hbvm {
namespace {

RunRequest pendulum() {
  return {.scene = load_scene("modified_pendulum"),
          .method = "hbvm:4,2",
          .step = "1/16",
          .until = 2,
          .precision = "mpfr:50"};
}

TEST(DoorRun, KeepsTheTrajectoryInAllDigits) {
  const hbvm::Run made = run(pendulum());
  EXPECT_EQ(made.steps, 32);
  EXPECT_EQ(made.method, "hbvm:4,2");
  EXPECT_EQ(made.precision, "mpfr:50");
  ASSERT_EQ(made.trajectory.rows.size(), 33u);
  const std::vector<std::string> x = made.trajectory.text("bob.x");
  EXPECT_EQ(x.back(), made.q.front());
  EXPECT_GT(x.back().size(), 50u);
  EXPECT_DOUBLE_EQ(made.trajectory.values("t")[1], 0.0625);
  EXPECT_DOUBLE_EQ(made.trajectory.values("bob.x").back(), std::stod(x.back()));
  EXPECT_LT(std::stod(made.e_H), 1e-14);
  EXPECT_GT(std::stod(made.e_H), 1e-40);
}

/// 50 digits without a scope of them, and whatever another thread or run has.
TEST(DoorRun, HasItsOwnPrecision) {
  RunRequest request = pendulum();
  const hbvm::Run first = run(request);
  request.precision = "double";
  const hbvm::Run in_double = run(request);
  EXPECT_LT(in_double.q.front().size(), 25u);
  request.precision = "mpfr:50";
  EXPECT_EQ(run(request).q, first.q);
}

TEST(DoorRun, KeepsRowsAsAsked) {
  RunRequest request = pendulum();
  request.every = 10;
  EXPECT_EQ(run(request).trajectory.text("t"), (std::vector<std::string>{"0", "0.625", "1.25", "1.875", "2"}));
  request.every = 0;
  EXPECT_TRUE(run(request).trajectory.rows.empty());
  request.every = -1;
  EXPECT_THROW(run(request), InputError);
}

/// A method and a step are there for who asks for none.
TEST(DoorRun, HasAMethodAndAStepOfItsOwn) {
  const hbvm::Run made = run({.scene = load_scene("kepler"), .until = 10});
  EXPECT_TRUE(made.method.starts_with("hbvm:")) << made.method;
  EXPECT_TRUE(made.nodes);
  EXPECT_EQ(made.step, "0.03125");
  EXPECT_EQ(made.steps, 320);
  EXPECT_NE(made.command.find("--step '1/32'"), std::string::npos) << made.command;
}

/// What was computed before a run ended on its way is a part of what it would have been.
TEST(DoorRun, HandsOutWhatItHasWhereItIsCutShort) {
  const hbvm::Run whole = run(pendulum());
  RunRequest request = pendulum();
  std::stop_source source;
  request.stop = source.get_token();
  request.progress = [&](long done, long) {
    if (done == 7) source.request_stop();
  };
  Trajectory kept;
  request.cut_short = [&](Trajectory so_far) { kept = std::move(so_far); };
  EXPECT_THROW(run(request), Interrupted);
  EXPECT_EQ(kept.columns, whole.trajectory.columns);
  ASSERT_EQ(kept.rows.size(), 8u);
  EXPECT_TRUE(std::equal(kept.rows.begin(), kept.rows.end(), whole.trajectory.rows.begin()));
}

TEST(DoorRun, TellsTheStepThatItWouldTake) {
  EXPECT_EQ(usual_step(load_scene("kepler"), 10), "1/32");
  EXPECT_EQ(usual_step(load_scene("kepler"), "2*pi"), "(2*pi)/2^7");
  EXPECT_THROW(usual_step(load_scene("kepler"), -1), InputError);
}

TEST(DoorRun, NamesTheColumnsThereAre) {
  const hbvm::Run made = run(pendulum());
  core::expect_words(core::message_of([&] { return made.trajectory.values("bob.z"); }),
                     {"'bob.z'; there are: t, bob.x, bob.y"});
}

TEST(DoorRun, GoesOnFromWhereAnotherEnded) {
  RunRequest request = pendulum();
  request.until = 1;
  const hbvm::Run first = run(request);
  request.start = to_json(first);
  const hbvm::Run second = run(request), whole = run(pendulum());
  for (std::size_t i = 0; i < whole.q.size(); ++i) EXPECT_NEAR(std::stod(second.q[i]), std::stod(whole.q[i]), 1e-15);
}

TEST(DoorRun, EndsWhenItIsAskedTo) {
  std::stop_source source;
  RunRequest request = pendulum();
  request.until = 1000;
  request.stop = source.get_token();
  long most = 0;
  request.progress = [&](long done, long) {
    most = done;
    if (done >= 100) source.request_stop();
  };
  try {
    run(request);
    FAIL() << "it went on to the end";
  } catch (const Interrupted& end) {
    EXPECT_EQ(end.signal(), 0);
    core::expect_words(end.what(), {"stopped after step"});
  }
  EXPECT_LT(most, 1000);
  request.stop = {};
  request.until = 1;
  EXPECT_EQ(run(request).steps, 16);  // a run of its own is not asked
}

TEST(DoorRun, MakesPictures) {
  RunRequest request = pendulum();
  request.precision = "double";
  request.picture = true;
  const hbvm::Run made = run(request);
  ASSERT_TRUE(made.figure);
  EXPECT_GT(made.figure->panels.size(), 1u);
  core::expect_words(made.figure->footnote, {made.command});
  core::expect_words(made.page, {"<html"});
  EXPECT_TRUE(made.frames.empty());
}

/// One for each step of a short run.
TEST(DoorRun, MakesFramesIfAsked) {
  RunRequest request = pendulum();
  request.frames = true;
  const hbvm::Run made = run(request);
  EXPECT_FALSE(made.figure);
  ASSERT_EQ(made.frames.size(), 32u);
  EXPECT_EQ(made.frames.back().panels.at(0).title, "t = 2.000");
}

TEST(DoorRun, RefusesWhatTheProgramRefuses) {
  const auto expect_refused = [](auto RunRequest::*field, const char* value) {
    RunRequest request = pendulum();
    request.*field = value;
    EXPECT_THROW(run(request), InputError) << value;
  };
  expect_refused(&RunRequest::method, "hbvn:4,2");
  expect_refused(&RunRequest::step, "1/16 +");
  expect_refused(&RunRequest::until, "1/30");
  expect_refused(&RunRequest::precision, "mpfr:3");
}

TEST(DoorRun, RefusesAStartInItsOwnPrecisionWithoutAStep) {
  const Scene off = read_scene(
      "dimension = 2\npoint = [{ name = 'o', position = [0, 0] }]\n"
      "body = [{ name = 'a', mass = 1, position = [1, '1/100'], velocity = [0, 0] }]\n"
      "constraint = [{ kind = 'rod', between = ['o', 'a'], length = 1 }]\n");
  try {
    static_cast<void>(run({.scene = off, .until = 1}));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("--precision double"), std::string::npos) << error.what();
  }
}

/// A method that needs more than the steps know, by name and without a call before.
TEST(DoorRun, KnowsEveryMethod) {
  RunRequest request = pendulum();
  request.method = "taylor";
  const hbvm::Run exact = run(request);
  EXPECT_LT(std::stod(exact.e_H), 1e-45);
}

}  // namespace
}  // namespace hbvm

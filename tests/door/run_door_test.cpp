#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

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
  expect_refused(&RunRequest::until, "-1/30");
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

/// States at times of one's own, events, and an end that is no multiple of the step.
TEST(DoorRun, TellStatesBetweenTheSteps) {
  RunRequest request{.scene = load_scene("simple_pendulum"), .method = "hbvm:8,8", .step = "1/4", .until = "10/3"};
  request.at = {"1/3", "10/3", "2"};
  request.every_time = "1";
  request.precision = "mpfr:30";
  const hbvm::Run made = hbvm::run(request);
  EXPECT_EQ(made.steps, 14);
  EXPECT_EQ(made.last_step.substr(0, 8), "0.083333");
  ASSERT_EQ(made.at.size(), 6u);  // 0, 1/3, 1, 2, 3, 10/3
  EXPECT_EQ(made.at[1].t.substr(0, 8), "0.333333");
  EXPECT_EQ(made.at[5].q, made.q);
  EXPECT_EQ(made.at[5].p, made.output_p);
  EXPECT_EQ(made.at[5].lambda, made.output_lambda);
  const auto json = nlohmann::json::parse(to_json(made));
  EXPECT_EQ(json.at("at").size(), 6u);
  core::expect_words(to_text(made), {"the last shortened to", "state at t = 2"});
  core::expect_words(made.command, {"--at '1/3,10/3,2'", "--every-time '1'"});
  request.at = {"4"};
  EXPECT_THROW(hbvm::run(request), InputError);
  request.at = {"-1"};
  EXPECT_THROW(hbvm::run(request), InputError);
  request.at = {"1"};
  request.prove = true;  // of equal steps
  EXPECT_THROW(hbvm::run(request), InputError);
}

TEST(DoorRun, TellEventsAndPeriods) {
  RunRequest request{.scene = load_scene("simple_pendulum"), .method = "hbvm:8,8", .step = "1/4", .until = "30"};
  request.scene.event("swing up: bob.x").event("turn: bob.vx").observe("height", "bob.y");
  const hbvm::Run made = hbvm::run(request);
  ASSERT_EQ(made.periods.size(), 3u);
  // What the scene observes is told of the state there.
  for (const Event& event : made.events) EXPECT_EQ(event.observed.at(0), event.q.at(1));
  EXPECT_EQ(made.periods[0].name, "swing");
  EXPECT_EQ(made.periods[0].crossings, 4);
  EXPECT_EQ(made.periods[0].least.substr(0, 12), "6.7430014192");
  EXPECT_EQ(made.periods[0].greatest.substr(0, 12), "6.7430014192");
  const auto json = nlohmann::json::parse(to_json(made));
  EXPECT_EQ(json.at("events").at(0).at("name"), "turn");
  EXPECT_EQ(json.at("events").at(0).at("direction"), "down");
  EXPECT_EQ(json.at("events").at(0).at("observed").at("height"), made.events[0].q[1]);
  core::expect_words(to_text(made), {"events\n", "swing up again after 6.7430014192"});
  // It ends at the third turn, at rest.
  request.until_event = "turn,3";
  const hbvm::Run third = hbvm::run(request);
  EXPECT_EQ(third.until.substr(0, 12), "8.4287517740");
  EXPECT_LT(std::abs(std::stod(third.output_p[0])), 1e-12);
  for (const char* const wrong : {"turn,0", "turn,", "turn,x", "no", "turn,99999999999"}) {
    request.until_event = wrong;
    EXPECT_THROW(hbvm::run(request), InputError) << wrong;
  }
}

/// Back in time the states are those of the opposite times.
TEST(DoorRun, TellStatesBackInTime) {
  RunRequest request{.scene = load_scene("conical_pendulum"), .method = "hbvm:6,6", .step = "1/8", .until = "2"};
  request.at = {"0.7"};
  const hbvm::Run forward = hbvm::run(request);
  request.reverse = true;
  const hbvm::Run backward = hbvm::run(request);
  EXPECT_EQ(backward.at.at(0).t, "-0.7");
  // The bob starts on the x axis and turns: there and back mirror each other.
  EXPECT_NEAR(std::stod(backward.at[0].q[0]), std::stod(forward.at.at(0).q[0]), 1e-12);
  EXPECT_NEAR(std::stod(backward.at[0].q[1]), -std::stod(forward.at[0].q[1]), 1e-12);
}

}  // namespace
}  // namespace hbvm

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "hbvm/error.hpp"
#include "hbvm/reference.hpp"
#include "words.hpp"

namespace hbvm {
namespace {

/// x = cos t, of a unit mass in a trap of strength 1.
Scene oscillator() {
  Scene scene(2, "oscillator");
  scene.title("An oscillator").body({.name = "a", .position = {1, 0}});
  scene.effect({.kind = "formula", .U = "-(x^2 + y^2)/2"});
  return scene;
}

TEST(DoorReference, HasTheDigitsOfTheCosine) {
  const Reference found = reference({.scene = oscillator(), .times = {"1/2", 1}, .digits = 40});
  ASSERT_EQ(found.times.size(), 2u);
  EXPECT_EQ(found.times[1].q[0].substr(0, 41), "0.540302305868139717400936607442976603732");
  EXPECT_GE(found.times[1].agreed, 40);
  const nlohmann::json json = nlohmann::json::parse(to_json(found));
  EXPECT_EQ(json.at("until"), "1");
  EXPECT_EQ(json.at("times").at(1).at("q"), found.times[1].q);
}

TEST(DoorReference, GivesOutAProofThatHolds) {
  const Reference found =
      reference({.scene = oscillator(), .times = {1}, .digits = 12, .prove = true, .keep_proof = true});
  EXPECT_EQ(found.proved, 12);
  double done = 0;
  const Reference checked = check_proof({.text = found.proof, .progress = [&](double part) { done = part; }});
  EXPECT_EQ(checked.times[0].q, found.times[0].q);
  EXPECT_EQ(checked.proved, 12);
  EXPECT_LE(done, 1);
  std::string changed = found.proof;
  changed.back() = ' ';
  EXPECT_THROW(check_proof({.text = changed}), InputError);
  EXPECT_THROW(reference({.scene = oscillator(), .times = {1}, .keep_proof = true}), InputError);
  EXPECT_TRUE(reference({.scene = oscillator(), .times = {1}, .digits = 12, .prove = true}).proof.empty());
}

TEST(DoorReference, RefusesTimesThatAreNone) {
  EXPECT_THROW(reference({.scene = oscillator(), .times = {}}), InputError);
  EXPECT_THROW(reference({.scene = oscillator(), .times = {"-1"}}), InputError);
  EXPECT_THROW(reference({.scene = oscillator(), .times = {1}, .digits = 0}), InputError);
  EXPECT_THROW(reference({.scene = oscillator(), .times = {1}, .route = "by_foot"}), InputError);
}

TEST(DoorReference, IsWrittenForOtherPrograms) {
  const Reference found = reference({.scene = oscillator(), .times = {1}, .digits = 12});
  EXPECT_NE(to_literals(found, "csv").find(found.times[0].q[0]), std::string::npos);
  EXPECT_THROW(to_literals(found, "cobol"), InputError);
}

TEST(DoorReference, EndsWhenItIsAskedTo) {
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(reference({.scene = oscillator(), .times = {1}, .stop = source.get_token()}), Interrupted);
}

TEST(DoorReferenceEvents, AreRefusedWithWhatIsWrong) {
  ReferenceRequest request{.scene = load_scene("simple_pendulum"), .times = {"7"}};
  core::expect_words(core::message_of<InputError>([&] { reference_events(request); }), {"no event"});
  request.scene.event("swing up: bob.x");
  ASSERT_EQ(reference_events(request).size(), 1u);
  ReferenceRequest wrong = request;
  wrong.times.clear();
  core::expect_words(core::message_of<InputError>([&] { reference_events(wrong); }), {"until when"});
  wrong = request;
  wrong.prove = true;
  core::expect_words(core::message_of<InputError>([&] { reference_events(wrong); }), {"two routes"});
  std::stop_source source;
  source.request_stop();
  request.stop = source.get_token();
  EXPECT_THROW(reference_events(request), Interrupted);
}

}  // namespace
}  // namespace hbvm

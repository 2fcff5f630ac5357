#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "hbvm/cost.hpp"
#include "hbvm/error.hpp"
#include "words.hpp"

namespace hbvm {
namespace {

TEST(DoorCost, PlansARunThatHasTheDigits) {
  const Plan found = plan({.scene = load_scene("simple_pendulum"), .until = 1, .digits = 10, .methods = {"gauss"}});
  ASSERT_TRUE(found.pick.error);
  EXPECT_LE(*found.pick.error, -10);
  EXPECT_GT(found.pick.steps, 0);
  EXPECT_EQ(nlohmann::json::parse(to_json(found)).at("pick").at("method"), found.pick.method);
  core::expect_words(found.text, {found.pick.method});
}

TEST(DoorCost, EndsWhenItIsAskedTo) {
  std::stop_source source;
  EXPECT_THROW(plan({.scene = load_scene("simple_pendulum"),
                     .until = 1,
                     .digits = 10,
                     .methods = {"gauss"},
                     .progress = [&](double) { source.request_stop(); },
                     .stop = source.get_token()}),
               Interrupted);
}

TEST(DoorCost, RefusesWhatIsNoQuestion) {
  EXPECT_THROW(plan({.scene = load_scene("kepler"), .until = 0}), InputError);
  EXPECT_THROW(plan({.scene = load_scene("kepler"), .until = 1, .quantity = "beauty"}), InputError);
}

}  // namespace
}  // namespace hbvm

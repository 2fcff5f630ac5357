#include "door/measured_values.hpp"

#include "words.hpp"

namespace hbvm::core {
namespace {

Measure run_of(const std::string& value) {
  Measure measure;
  measure.kind = "run";
  measure.scene = "kepler";
  measure.methods = {"hbvm:3,3"};
  measure.step = "1/8";
  measure.until = "1";
  measure.values = {{"value", value}};
  return measure;
}

TEST(MeasuredValues, AreThoseOfTheResult) {
  Measure run = run_of("/steps");
  run.values.emplace_back("t", "/t");
  EXPECT_EQ(measured_values(run, {}), (NamedTexts{{"value", "8"}, {"t", "1"}}));
  Measure tableau = run_of("/method");
  tableau.methods = {"tableau:mine.toml+project"};
  tableau.files = {{"mine.toml", "A = [[0]]\nb = [1]\n"}};
  expect_words(measured_values(tableau, {}).at(0).second, {"mine.toml+project"});
  Measure audit;
  audit.kind = "audit";
  audit.tableau = "A = [[\"1/2\"]]\nb = [1]\norder = 2\n";
  audit.values = {{"order", "/claims/0/predicted"}};
  EXPECT_EQ(measured_values(audit, {}).at(0).second, "2.0");
}

/// Gauss's method returns, and that of Runge and Kutta does not.
TEST(MeasuredValues, MayBeThoseOfTheWayBack) {
  const auto x = [](const char* method) {
    Measure measure = run_of("/q/0");
    measure.methods = {method};
    measure.back = true;
    return std::stod(measured_values(measure, {}).at(0).second);
  };
  EXPECT_NEAR(x("hbvm:3,3"), 0.5, 1e-14);
  EXPECT_GT(std::abs(x("rk4") - 0.5), 1e-8);
}

TEST(MeasuredValues, SayWhatThereIsNot) {
  expect_words(message_of([] { measured_values(run_of("/nowhere"), {}); }), {"run", "/nowhere"});
  expect_words(message_of([] { measured_values(run_of("/q/x"), {}); }), {"/q/x"});
  expect_words(message_of([] { measured_values(run_of("q"), {}); }), {"has no q"});
  Measure scene = run_of("/steps");
  scene.scene = "dimension = 2\nbody = 3\n";
  EXPECT_THROW(measured_values(scene, {}), InputError);
}

/// An answer may ask for any time; it gets a minute.
TEST(MeasuredValues, EndWhenTheyAreAskedTo) {
  std::stop_source source;
  source.request_stop();
  Measure longer = run_of("/steps");
  longer.until = "100000000";
  EXPECT_THROW(measured_values(longer, source.get_token()), Interrupted);
  expect_words(message_of([&] { measured_values(longer, {}, 0); }), {"longer than a minute", "longer steps"});
}

TEST(MeasuredValues, OfAReferenceHaveAWholeNumberOfDigits) {
  Measure reference = run_of("/times/0/q/0");
  reference.kind = "reference";
  reference.digits = "20";
  EXPECT_GT(measured_values(reference, {}).at(0).second.size(), 20u);
  reference.digits = "many";
  expect_words(message_of([&] { measured_values(reference, {}); }), {"'many'", "whole number"});
}

}  // namespace
}  // namespace hbvm::core

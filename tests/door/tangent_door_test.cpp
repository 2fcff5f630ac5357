#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "hbvm/error.hpp"
#include "hbvm/tangent.hpp"
#include "words.hpp"

namespace hbvm {
namespace {

TEST(DoorTangent, TellsWhenAPrecisionHasNoDigitLeft) {
  TangentRequest request{.scene = load_scene("chaotic_double_pendulum"), .method = "hbvm:4,4", .step = "1/8"};
  request.until = 160;
  const Tangent found = tangent(request);
  ASSERT_EQ(found.horizons.size(), 4u);
  EXPECT_EQ(found.horizons[0].precision, "double");
  ASSERT_TRUE(found.horizons[0].t && found.horizons[2].t);
  EXPECT_LT(*found.horizons[0].t, *found.horizons[2].t);
  EXPECT_TRUE(found.horizons[3].extrapolated);
  EXPECT_TRUE(found.multipliers.empty());
  core::expect_words(to_text(found),
                     {"Lyapunov exponents", "double     has no digit left at t = ", "if it goes on so"});
  const auto json = nlohmann::json::parse(to_json(found));
  EXPECT_EQ(json.at("exponents").size(), 4u);
  // The means tend to the exponents, but for the first tenth of the time.
  ASSERT_EQ(found.means.size(), found.times.size());
  EXPECT_NEAR(found.means.back()[0], found.exponents[0].value, found.exponents[0].uncertainty);
  EXPECT_NEAR(found.means.back()[0], -found.means.back()[3], found.exponents[0].uncertainty);
  EXPECT_EQ(figure_of(found).panels.size(), 2u);
  EXPECT_EQ(json.at("directions").size(), 4u);
  EXPECT_EQ(json.at("directions").at(0).size(), found.names.size());
}

/// A motion that closes: both multipliers of one degree of freedom are 1.
TEST(DoorTangent, HasMultipliersOfAMotionThatCloses) {
  TangentRequest request{.scene = load_scene("conical_pendulum"), .method = "hbvm:8,8"};
  request.step = "2^(3/4)*pi/40";
  request.until = "2^(3/4)*pi";
  const Tangent found = tangent(request);
  ASSERT_EQ(found.multipliers.size(), 4u);
  double product = 1;
  for (const Multiplier& multiplier : found.multipliers) product *= std::hypot(multiplier.real, multiplier.imaginary);
  EXPECT_NEAR(product, 1, 1e-6);
  core::expect_words(to_text(found), {"the motion closes"});
}

TEST(DoorTangent, TellsSensitivities) {
  TangentRequest request{.scene = load_scene("simple_pendulum"), .until = 4};
  request.scene = read_scene(
      "dimension = 2\nconstants = { g = 1 }\npoint = [{ name = \"o\", position = [0, 0] }]\n"
      "body = [{ name = \"bob\", mass = 1, position = [0, -1], velocity = [1, 0] }]\n"
      "constraint = [{ kind = \"rod\", between = [\"o\", \"bob\"], length = 1 }]\n"
      "effect = [{ kind = \"uniform_gravity\", acceleration = [0, \"-g\"] }]\n");
  request.constants = {"g"};
  const Tangent found = tangent(request);
  ASSERT_EQ(found.sensitivities.size(), 1u);
  EXPECT_EQ(found.sensitivities[0].second.size(), 4u);
  // The bob stays on its circle: x dx + y dy = 0.
  const auto number = [](const std::string& text) { return std::stod(text); };
  const auto& change = found.sensitivities[0].second;
  EXPECT_NEAR(number(found.end[0]) * number(change[0]) + number(found.end[1]) * number(change[1]), 0, 1e-12);
  request.constants = {"none"};
  EXPECT_THROW(tangent(request), InputError);
}

/// As Ctrl-C does.
TEST(DoorTangent, EndWhenTheyAreAskedTo) {
  std::stop_source source;
  source.request_stop();
  TangentRequest request{.scene = load_scene("kepler"), .step = "1/8"};
  request.until = 10;
  request.stop = source.get_token();
  EXPECT_THROW(tangent(request), Interrupted);
}

}  // namespace
}  // namespace hbvm

#include "run/run_page.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>

#include "hbvm/error.hpp"
#include "runs/request_of.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

using Json = nlohmann::json;

RunRequest request_for(const Scene& scene) { return request_of(scene, "hbvm:2,2", "1/16", "1"); }

Recording recording_of(const Scene& scene, const std::string& until = "1") {
  return recorded<double>(scene, "1/16", until).first;
}

/// The text of the element that begins so.
std::string element(const std::string& page, const std::string& begin) {
  const std::size_t at = page.find(begin);
  EXPECT_NE(at, std::string::npos) << begin;
  const std::size_t from = page.find('>', at) + 1;
  return page.substr(from, page.find("</", from) - from);
}

Json data_of(const std::string& page) { return Json::parse(element(page, "<script type=\"application/json\"")); }

double number(const Json& value) {
  return value.is_string() ? std::stod(value.get<std::string>()) : value.get<double>();
}

TEST(RunPage, IsAskedForByItsEnding) {
  EXPECT_TRUE(is_page("a/motion.html"));
  EXPECT_FALSE(is_page("motion.svg"));
  EXPECT_FALSE(is_page("motion.html.svg"));
}

TEST(RunPage, HoldsTheNumbersOfTheRecordingExactly) {
  const Scene scene = load_scene("double_pendulum");
  const Recording recording = recording_of(scene);
  const Json data = data_of(run_page(request_for(scene), recording, "hbvm run"));
  ASSERT_EQ(data["samples"].size(), recording.samples.size());
  ASSERT_EQ(data["charts"].size(), 2u);
  for (std::size_t n = 0; n < recording.samples.size(); ++n) {
    const Recording::Sample& sample = recording.samples[n];
    const Json& row = data["samples"][n];
    EXPECT_EQ(number(row[0]), sample.t);
    for (std::size_t i = 0; i < sample.q.size(); ++i) EXPECT_EQ(number(row[1 + i]), sample.q[i]);
    for (std::size_t i = 0; i < 2; ++i) {
      const Json& curve = data["charts"][0]["curves"][i];
      EXPECT_EQ(curve["name"], recording.constraints[i]);
      EXPECT_EQ(number(row[curve["column"].get<std::size_t>()]), sample.lambda[i]);
    }
    const auto error = [&](std::size_t i) {
      return number(row[data["charts"][1]["curves"][i]["column"].get<std::size_t>()]);
    };
    EXPECT_EQ(error(0), sample.energy);
    EXPECT_EQ(error(1), sample.constraints);
    EXPECT_EQ(error(2), sample.hidden);
  }
  EXPECT_EQ(data["steps"], 16);
  EXPECT_EQ(data["every"], 1);
  EXPECT_EQ(data["last_step"], 16);
}

/// Of what has mass, at each state, in as many digits as are drawn.
TEST(RunPage, HoldsTheVelocitiesThatBendThePaths) {
  const Scene scene = load_scene("double_pendulum");
  Recording recording = recording_of(scene);
  const Json velocities = data_of(run_page(request_for(scene), recording, "hbvm run"))["velocities"];
  ASSERT_EQ(velocities.size(), recording.samples.size());
  for (std::size_t n = 0; n < velocities.size(); ++n) {
    const std::vector<double>& v = recording.samples[n].v;
    ASSERT_EQ(v.size(), 4u);
    for (std::size_t i = 0; i < v.size(); ++i)
      EXPECT_NEAR(number(velocities[n].at(i / 2).at(i % 2)), v[i], 1e-4 * std::abs(v[i]));
  }
  for (Recording::Sample& sample : recording.samples) sample.v.clear();
  EXPECT_TRUE(data_of(run_page(request_for(scene), recording, "hbvm run"))["velocities"].empty());
}

/// Of a scene without constraints there are no multipliers, and no errors of constraints.
TEST(RunPage, LeavesOutWhatASceneHasNot) {
  const Scene scene = load_scene("kepler");
  const Json data = data_of(run_page(request_for(scene), recording_of(scene), "hbvm run"));
  ASSERT_EQ(data["charts"].size(), 1u);
  EXPECT_EQ(data["charts"][0]["curves"].size(), 1u);
}

TEST(RunPage, NeedsNothingBesidesItself) {
  const Scene scene = load_scene("tethered_satellites");
  const std::string page =
      run_page(request_for(scene), recording_of(scene), "hbvm run tethered_satellites --step '1/16'");
  for (const char* const outside : {"<script src", "<img", "<link", "@import", "url(", "sourceMappingURL"})
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  EXPECT_FALSE(std::regex_search(page, std::regex(R"(\{\{[a-z]+\}\})"))) << "a word of the form is left";
  expect_words(page, {"default-src 'none'", "dygraphs", "MIT"});
  EXPECT_EQ(element(page, "<pre id=\"command\""), "hbvm run tethered_satellites --step &#39;1/16&#39;");
  expect_words(element(page, "<pre id=\"scene\""), {"radial_cosine"});
  EXPECT_EQ(element(page, "<p id=\"account\"").substr(0, 26), "Every state of 16 steps. W");
}

/// A title and names are text of strangers.
TEST(RunPage, LetsNoTextOutOfItsPlace) {
  Scene scene = load_scene("simple_pendulum");
  scene.title = "</title><script>alert(1)</script> & 'more' {{data}}";
  scene.bodies[0].name = "</script><!--";
  for (auto& constraint : scene.constraints)
    for (auto& [key, pair] : constraint.pairs)
      for (std::string& end : pair)
        if (end == load_scene("simple_pendulum").bodies[0].name) end = scene.bodies[0].name;
  const std::string page = run_page(request_for(scene), recording_of(scene), "hbvm <run>");
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  expect_words(page, {"&lt;/title&gt;&lt;script&gt;alert(1)&lt;/script&gt; &amp; &#39;more&#39; {{data}}"});
  EXPECT_EQ(page.find("<!--"), std::string::npos);
  const Json data = data_of(page);
  const Json& places = data["sketch"]["places"];
  EXPECT_TRUE(std::any_of(places.begin(), places.end(), [](const Json& p) { return p["name"] == "</script><!--"; }));
}

/// A recording with as many coordinates as a large chain.
Recording large(std::size_t samples, std::size_t coordinates) {
  Recording recording;
  recording.steps = static_cast<long>(3 * (samples - 1));
  recording.every = 3;
  for (std::size_t n = 0; n < samples; ++n) {
    const auto x = static_cast<double>(n);
    recording.samples.push_back({x / 7, std::vector<double>(coordinates, std::sin(x / 3)), {}, std::exp(-x), 0, 0});
  }
  recording.samples[samples / 2 + 1].energy = 7;
  return recording;
}

TEST(RunPage, IsSmallAndLeavesNoErrorOut) {
  const Scene scene = load_scene("kepler");
  const Recording recording = large(1001, 400);
  const std::string page = run_page(request_for(scene), recording, "hbvm run");
  EXPECT_LT(page.size(), moving_page_bytes);
  const Json data = data_of(page);
  const std::size_t column = data["charts"][0]["curves"][0]["column"];
  double greatest = 0;
  for (const Json& row : data["samples"]) greatest = std::max(greatest, number(row[column]));
  EXPECT_EQ(greatest, 7);
  EXPECT_EQ(number(data["samples"].front()[0]), 0);
  EXPECT_EQ(number(data["samples"].back()[0]), recording.samples.back().t);
  const long every = data["every"];
  EXPECT_GT(every, 3);
  EXPECT_EQ(every % 3, 0);
  expect_words(element(page, "<p id=\"account\""), {"Every " + std::to_string(every), "of 3000 steps, and the last"});
  EXPECT_THROW(run_page(request_for(scene), large(4, 60'000), "hbvm run"), Error);
}

/// A run that fails on the way is shown as far as it came.
TEST(RunPage, SaysThatARunEndedEarly) {
  const Scene scene = load_scene("kepler");
  Recording recording = recording_of(scene);
  recording.steps = 100;
  const std::string page = run_page(request_for(scene), recording, "hbvm run");
  expect_words(page, {"The run ended early: what is shown ends at t = 1."});
  EXPECT_EQ(data_of(page)["last_step"], 16);
}

TEST(RunPage, SaysWhereARunBackwardsEnds) {
  const Scene scene = load_scene("kepler");
  RunRequest request = request_for(scene);
  request.direction = Direction::backward;
  const Recording recording = recording_of(scene);
  expect_words(run_page(request, recording, "hbvm run"), {"· until −1<"});
  request.until = Expression::parse("2 - 1");
  expect_words(run_page(request, recording, "hbvm run"), {"· until −(2 - 1)<"});
}

TEST(RunPage, NumbersMultipliersByTheirConstraints) {
  const Scene scene = load_scene("double_physical_pendulum");
  const Recording recording = recording_of(scene);
  const Json curves = data_of(run_page(request_for(scene), recording, "hbvm run"))["charts"][0]["curves"];
  ASSERT_EQ(curves.size(), 2u);
  for (const Json& curve : curves)
    EXPECT_EQ(curve["name"], recording.constraints.at(curve["number"].get<std::size_t>() - 1));
  EXPECT_EQ(curves[0]["label"], "ball joint upper-lower, x");
}

/// Bodies that look alike share what they look like; a surface is there if a body is held on one.
TEST(RunPage, HoldsSolidsAndSurfaces) {
  const auto sketch_of = [](const std::string& name) {
    const Scene scene = load_scene(name);
    return data_of(run_page(request_for(scene), recording_of(scene), "hbvm run"))["sketch"];
  };
  const Json gimbal = sketch_of("gyroscope_on_gimbal");
  ASSERT_EQ(gimbal["bodies"].size(), 3u);
  for (const Json& body : gimbal["bodies"]) {
    EXPECT_EQ(body["directors"].size(), 3u);
    EXPECT_TRUE(gimbal["places"][body["place"].get<std::size_t>()]["has_mass"]);
    const Json& solid = gimbal["solids"][body["solid"].get<std::size_t>()];
    EXPECT_EQ(solid["corners"].size(), 72u);
    EXPECT_GE(solid["faces"].size(), 36u);
    EXPECT_GE(solid["edges"].size(), 108u);
  }
  EXPECT_TRUE(gimbal["meshes"].empty() && gimbal["curves"].empty());
  EXPECT_GT(sketch_of("bead_on_torus")["meshes"].size(), 10u);
  EXPECT_EQ(sketch_of("bead_on_helix")["curves"].size(), 1u);
  Scene twins = load_scene("free_rigid_body");
  twins.rigid_bodies.push_back(twins.rigid_bodies.front());
  twins.rigid_bodies.back().name = "twin";
  const Json two = data_of(run_page(request_for(twins), recording_of(twins), "hbvm run"))["sketch"];
  EXPECT_EQ(two["bodies"].size(), 2u);
  EXPECT_EQ(two["solids"].size(), 1u);
}

TEST(RunPage, CountsOneStep) {
  const Scene scene = load_scene("kepler");
  const std::string page = run_page(request_for(scene), recording_of(scene, "1/16"), "hbvm run");
  EXPECT_TRUE(element(page, "<p id=\"account\"").starts_with("Every state of 1 step. "));
}

/// JSON has no infinities: they are text that JavaScript's Number() reads.
TEST(RunPage, HoldsWhatIsNotFinite) {
  const Scene scene = load_scene("kepler");
  Recording recording = recording_of(scene);
  recording.samples[3].energy = std::numeric_limits<double>::quiet_NaN();
  recording.samples[4].energy = std::numeric_limits<double>::infinity();
  const Json data = data_of(run_page(request_for(scene), recording, "hbvm run"));
  const std::size_t column = data["charts"][0]["curves"][0]["column"];
  EXPECT_EQ(data["samples"][3][column], "NaN");
  EXPECT_EQ(data["samples"][4][column], "Infinity");
  EXPECT_EQ(data["samples"][0][column], "-Infinity") << "of an error that is 0";
}

}  // namespace
}  // namespace hbvm::core

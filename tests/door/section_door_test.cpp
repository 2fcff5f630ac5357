#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "hbvm/error.hpp"
#include "hbvm/section.hpp"
#include "words.hpp"

namespace hbvm {
namespace {

SectionRequest request() {
  return {.scene = load_scene("double_pendulum"),
          .plane = "a.x",
          .axes = {"b.x", "b.vx"},
          .starts = {"b.mass=1,2"},
          .method = "hbvm:2,2",
          .step = "1/8",
          .until = 30};
}

TEST(DoorSection, TellsPointsOfOrbits) {
  SectionRequest asked = request();
  long done = 0;
  asked.progress = [&](long now, long) { done = now; };
  const Section found = section(asked);
  EXPECT_EQ(done, 2);
  core::expect_words(to_text(found), {"orbit 2, b.mass = 2", "the orbits differ in H"});
  const auto json = nlohmann::json::parse(to_json(found));
  EXPECT_EQ(json.at("orbits").at(1).at("start").at("b.mass"), "2");
  EXPECT_EQ(json.at("orbits").at(0).at("points").size(), found.orbits[0].points.size());
  const std::string csv = to_csv(found);
  EXPECT_EQ(csv.substr(0, csv.find('\n')), "orbit,b.mass,t,b.x,b.vx");
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')),
            1 + found.orbits[0].points.size() + found.orbits[1].points.size());
  EXPECT_FALSE(figure_of(found).panels.empty());
  EXPECT_FALSE(page_of(found, asked).empty());
}

/// Crossings of both directions are those up and those down.
TEST(DoorSection, CountsDirections) {
  std::size_t counts[3] = {};
  std::size_t n = 0;
  for (const char* const direction : {"up", "down", "any"}) {
    SectionRequest asked = request();
    asked.direction = direction;
    counts[n++] = section(asked).orbits[0].points.size();
  }
  EXPECT_GT(counts[0], 2u);
  EXPECT_EQ(counts[0] + counts[1], counts[2]);
}

TEST(DoorSection, IsRefused) {
  for (const auto& change :
       {+[](SectionRequest& r) { r.plane = "nobody.x"; }, +[](SectionRequest& r) { r.plane = "a.x +"; },
        +[](SectionRequest& r) { r.direction = "sideways"; }, +[](SectionRequest& r) { r.axes.first = "a.x +"; },
        +[](SectionRequest& r) { r.starts = {"nothing=1,2"}; }}) {
    SectionRequest asked = request();
    change(asked);
    EXPECT_THROW(section(asked), InputError);
  }
}

}  // namespace
}  // namespace hbvm

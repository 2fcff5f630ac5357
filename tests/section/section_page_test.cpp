#include "section/section_page.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "door/section_of.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

/// The page has the points of every orbit, and where its bodies go at first.
TEST(SectionPage, HasPointsAndPaths) {
  SectionRequest request{.scene = hbvm::load_scene("double_pendulum"),
                         .plane = "a.x",
                         .axes = {"b.x", "b.vx"},
                         .starts = {"b.mass=1,2"},
                         .method = "hbvm:2,2",
                         .step = "1/8",
                         .until = "30"};
  const SectionWork work = section_work(request);
  const Section section = *run_section(work, {});
  const std::string page = section_page(section, work);
  for (const char* const left : {"@title@", "@heading@", "@about@", "@footer@", "@data@", "http://", "https://"})
    EXPECT_EQ(page.find(left), std::string::npos) << left;
  const std::string begin = "<script type=\"application/json\" id=\"data\">";
  const std::size_t from = page.find(begin) + begin.size();
  const auto data = nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
  ASSERT_EQ(data.at("orbits").size(), 2u);
  for (std::size_t n = 0; n < 2; ++n) {
    const auto& orbit = data.at("orbits").at(n);
    ASSERT_EQ(orbit.at("points").size(), section.orbits[n].points.size());
    EXPECT_NEAR(orbit.at("points").at(0).at(0).get<double>(), std::stod(section.orbits[n].points[0].x), 1e-4);
    EXPECT_EQ(orbit.at("paths").size(), 2u);
    EXPECT_EQ(orbit.at("start").at(0), n == 0 ? "1" : "2");
  }
  expect_words(page, {"Double pendulum, masses 2 and 1", "Where a.x = 0, upwards"});
}

}  // namespace
}  // namespace hbvm::core

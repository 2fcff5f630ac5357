#include "run/moving_page.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "hbvm/error.hpp"
#include "scene/scene.hpp"

namespace hbvm::core {
namespace {

MovingPage page_of(std::size_t times, std::size_t coordinates) {
  MovingPage page;
  page.sketch = sketch(load_scene("kepler"));
  page.steps = page.last_step = static_cast<long>(times) - 1;
  PageChart chart{"title", "x", AxisScale::linear, {{"error", {}, 0, true}, {"value", {}}}};
  for (std::size_t n = 0; n < times; ++n) {
    const auto x = static_cast<double>(n);
    page.t.push_back(x / 7);
    page.q.emplace_back(coordinates, (x + 1) / 7);
    page.v.emplace_back(coordinates, x);
    chart.curves[0].values.push_back(n == 5 ? 9 : 1);
    chart.curves[1].values.push_back(n == 5 ? 9 : 1);
  }
  page.charts.push_back(chart);
  return page;
}

nlohmann::json data_of(const MovingPage& page) {
  const std::string text = moving_page(page);
  EXPECT_LT(text.size(), moving_page_bytes);
  const std::size_t at = text.find('>', text.find("<script type=\"application/json\"")) + 1;
  return nlohmann::json::parse(text.substr(at, text.find("</", at) - at));
}

/// Where there is no room for all times, of errors the greatest is left, of other values that of the time.
TEST(MovingPage, LeavesNoErrorOut) {
  const nlohmann::json data = data_of(page_of(1001, 400));
  double error = 0, value = 0;
  for (const nlohmann::json& row : data["samples"]) {
    error = std::max(error, row[401].get<double>());
    value = std::max(value, row[402].get<double>());
  }
  EXPECT_GT(data["every"], 1);
  EXPECT_EQ(error, 9);
  EXPECT_EQ(value, 1);
  EXPECT_EQ(data["samples"].back()[0], 1000 / 7.0);
  ASSERT_EQ(data["velocities"].size(), data["samples"].size());
  EXPECT_EQ(data["velocities"][1][0][0], data["every"]);
  EXPECT_EQ(data["velocities"].back()[0][0], 1000);
  EXPECT_THROW(moving_page(page_of(4, 60'000)), Error);
}

TEST(MovingPage, GivesPlacesTheirColours) {
  MovingPage page = page_of(3, 2);
  EXPECT_FALSE(data_of(page)["sketch"]["places"][0].contains("colour"));
  page.colours = {-1, 4};
  EXPECT_EQ(data_of(page)["sketch"]["places"][1]["colour"], 4);
}

}  // namespace
}  // namespace hbvm::core

#include "run/trajectory_metadata.hpp"

#include <gtest/gtest.h>

#include <map>

#include "hbvm/version.hpp"
#include "runs/request_of.hpp"

namespace hbvm::core {
namespace {

TEST(TrajectoryMetadata, SaysWhatWasRun) {
  RunRequest request = request_of(load_scene("kepler"), "hbvm:4,2", "2*pi/64", "2*pi");
  const auto properties = [&] {
    const CsvMetadata metadata = trajectory_metadata(request, {{"t", "time"}}, "hbvm run kepler", 3);
    return std::map<std::string, std::string>(metadata.properties.begin(), metadata.properties.end());
  };
  const std::map<std::string, std::string> expected{
      {"version", version()}, {"command", "hbvm run kepler"}, {"scene", "kepler"}, {"method", "hbvm:4,2"},
      {"solver", "auto"},     {"precision", "double"},        {"step", "2*pi/64"}, {"until", "2*pi"},
      {"every", "3"}};
  EXPECT_EQ(properties(), expected);
  request.direction = Direction::backward;
  EXPECT_EQ(properties().at("reverse"), "true");

  const CsvMetadata metadata = trajectory_metadata(request, {{"t", "time"}}, "", 1);
  EXPECT_EQ(metadata.title, request.scene.title);
  EXPECT_EQ(metadata.source, write_scene(request.scene));
  ASSERT_EQ(metadata.columns.size(), 1u);
  EXPECT_EQ(metadata.columns[0].name, "t");
  EXPECT_EQ(metadata.columns[0].description, "time");
  EXPECT_EQ(metadata.columns[0].type, CsvType::binary64);
  for (const char* const precision : {"quad", "mpfr:50"}) {
    request.precision = Precision::parse(precision);
    EXPECT_EQ(trajectory_metadata(request, {{"t", ""}}, "", 1).columns[0].type, CsvType::decimal);
  }
}

}  // namespace
}  // namespace hbvm::core

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "hbvm/error.hpp"
#include "hbvm/study.hpp"

namespace hbvm {
namespace {

TEST(DoorStudy, EndsWhenItIsAskedTo) {
  const std::filesystem::path out = std::filesystem::temp_directory_path() / "hbvm_door_study_ended";
  std::stop_source source;
  StudyRequest request{.folder = HBVM_SOURCE_DIR "/studies/table_1_simple_pendulum", .out = out.string()};
  request.progress = [&](long, long) { source.request_stop(); };
  request.stop = source.get_token();
  EXPECT_THROW(study(request), Interrupted);
  std::filesystem::remove_all(out);
}

TEST(DoorStudy, MeetsWhatIsPrinted) {
  const std::filesystem::path out = std::filesystem::temp_directory_path() / "hbvm_door_study";
  const Study found =
      study({.folder = HBVM_SOURCE_DIR "/studies/table_1_simple_pendulum", .precision = "double", .out = out.string()});
  EXPECT_GT(found.stated, 10);
  EXPECT_EQ(found.agreed, found.stated);
  EXPECT_EQ(nlohmann::json::parse(to_json(found)).at("agreed"), found.agreed);
  std::filesystem::remove_all(out);
  EXPECT_THROW(study({.folder = "/nowhere"}), InputError);
}

}  // namespace
}  // namespace hbvm

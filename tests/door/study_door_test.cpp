#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "folder.hpp"
#include "hbvm/error.hpp"
#include "hbvm/study.hpp"

namespace hbvm {
namespace {

TEST(DoorStudy, EndsWhenItIsAskedTo) {
  const core::Folder out;
  std::stop_source source;
  StudyRequest request{.folder = HBVM_SOURCE_DIR "/studies/table_1_simple_pendulum", .out = out / "."};
  request.progress = [&](long, long) { source.request_stop(); };
  request.stop = source.get_token();
  EXPECT_THROW(study(request), Interrupted);
}

TEST(DoorStudy, MeetsWhatIsPrinted) {
  const core::Folder out;
  const Study found =
      study({.folder = HBVM_SOURCE_DIR "/studies/table_1_simple_pendulum", .precision = "double", .out = out / "."});
  EXPECT_GT(found.stated, 10);
  EXPECT_EQ(found.agreed, found.stated);
  EXPECT_EQ(nlohmann::json::parse(to_json(found)).at("agreed"), found.agreed);
  EXPECT_THROW(study({.folder = "/nowhere"}), InputError);
}

}  // namespace
}  // namespace hbvm

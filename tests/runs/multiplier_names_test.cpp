#include "run/multiplier_names.hpp"

#include <gtest/gtest.h>

#include "runs/request_of.hpp"

namespace hbvm::core {
namespace {

using Names = std::vector<std::string>;

Names names_in(const char* scene) {
  return multiplier_names(recorded<double>(load_scene(scene), "1/16", "1/16").first);
}

TEST(MultiplierNames, CallJointsByTheirBodies) {
  EXPECT_EQ(names_in("four_bar_linkage_of_bars"),
            (Names{"ball joint crank-coupler, x", "ball joint crank-coupler, y", "ball joint coupler-rocker, x",
                   "ball joint coupler-rocker, y"}));
  const Names gimbal = names_in("gyroscope_on_gimbal");
  EXPECT_EQ(gimbal.front(), "hinge post-outer, across e");
  EXPECT_EQ(gimbal[1], "hinge post-outer, across f");
  EXPECT_EQ(gimbal[4], "hinge inner-rotor, x");
  EXPECT_EQ(gimbal.back(), "hinge inner-rotor, across f");
}

TEST(MultiplierNames, OfOtherConstraintsAreTheirOwn) {
  EXPECT_EQ(names_in("double_pendulum"), (Names{"rod pivot-a", "rod a-b"}));
  EXPECT_EQ(names_in("bead_on_torus"), (Names{"formula of bead"}));
  EXPECT_EQ(names_in("bead_on_helix"), (Names{"formula of bead, 1", "formula of bead, 2"}));
  EXPECT_EQ(names_in("heavy_top")[1], "directors 1 and 2 of top");
}

/// Two joints between the same bodies are told apart by their points; underscores of names are left.
TEST(MultiplierNames, AreUnique) {
  Recording recording;
  recording.constraints = {"ball_joint 'my_door[0, 0]'-'wall' (point, x)",
                           "ball_joint 'my_door[0, 1]'-'wall' (point, x)",
                           "ball_joint 'my_door[0, 1]'-'wall' (point, y)"};
  EXPECT_EQ(multiplier_names(recording), (Names{"ball joint my_door[0, 0]-wall, x", "ball joint my_door[0, 1]-wall, x",
                                                "ball joint my_door-wall, y"}));
}

}  // namespace
}  // namespace hbvm::core

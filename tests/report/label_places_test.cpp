#include "report/label_places.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace hbvm::core {
namespace {

constexpr Rectangle picture{0, 0, 330, 270};

std::vector<LabelledMark> crowd(std::size_t count, double within) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<LabelledMark> marks;
  for (std::size_t i = 0; i < count; ++i)
    marks.push_back({{100 + within * share(random), 100 + within * share(random)}, 20 + 40 * share(random), 14});
  return marks;
}

TEST(LabelPlaces, AreDisjoint) {
  for (const double within : {20, 60, 150}) {
    const std::vector<LabelledMark> marks = crowd(30, within);
    std::vector<Rectangle> found;
    for (const auto& place : label_places(marks, picture))
      if (place) found.push_back(*place);
    EXPECT_GE(found.size(), 4u);
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_TRUE(found[i].is_within(picture));
      for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(found[i].overlaps(found[j])) << within << " " << i << " " << j;
      for (const LabelledMark& mark : marks)
        EXPECT_FALSE(found[i].overlaps({mark.at[0], mark.at[1], 0.1, 0.1})) << "it stands on a mark";
    }
  }
}

/// Beside it, each one at its own mark; the first mark chooses first, and to the right.
TEST(LabelPlaces, AreBesideTheirMarks) {
  const auto places =
      label_places({{{100, 100}, 40, 14}, {{112, 100}, 40, 14}, {{320, 50}, 40, 14}, {{9, 9}, 0, 14}}, picture);
  ASSERT_TRUE(places[0] && places[1] && places[2]);
  EXPECT_LT(places[0]->left + 40, 100) << "the mark to the right is in the way";
  EXPECT_GT(places[1]->left, 112);
  EXPECT_LT(places[2]->left + 40, 320) << "the box ends";
  EXPECT_FALSE(places[3]) << "there is nothing to write";
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(places[i]->width, 40);
}

TEST(LabelPlaces, LeaveOutTheLastWhereThereIsNoRoom) {
  const std::vector<LabelledMark> marks(12, {{100, 100}, 200, 14});
  const auto places = label_places(marks, picture);
  EXPECT_TRUE(places.front());
  EXPECT_FALSE(places.back());
  EXPECT_FALSE(label_places({{{100, 100}, 400, 14}}, picture)[0]) << "it is wider than the box";
}

}  // namespace
}  // namespace hbvm::core

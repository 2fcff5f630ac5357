#include "cost/cost_grid.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "cost/cost_methods.hpp"

namespace hbvm::core {
namespace {

CostStudy study_of(const char* scene, const std::vector<std::string>& methods, double most_digits) {
  CostStudy study{load_scene(scene), Expression::parse("10")};
  study.most_digits = most_digits;
  study.methods = cost_methods(methods, most_digits);
  return study;
}

std::vector<std::string> keys_of(const std::vector<CostCell>& cells) {
  std::vector<std::string> keys;
  for (const CostCell& cell : cells) keys.push_back(cell.key());
  return keys;
}

const MotionNature gentle{1, -0.5};

TEST(CostGrid, HasNoCellTwiceAndAlwaysTheSameOrder) {
  const CostStudy study = study_of("kepler", {"gauss", "rattle"}, 30);
  const std::vector<std::string> keys = keys_of(cost_grid(study, gentle));
  EXPECT_EQ(keys, keys_of(cost_grid(study, gentle)));
  EXPECT_EQ(std::set<std::string>(keys.begin(), keys.end()).size(), keys.size());
  EXPECT_GT(keys.size(), 50u);
  EXPECT_FALSE(std::is_sorted(keys.begin(), keys.end()));
}

TEST(CostGrid, LeavesOutWhatTakesTooLong) {
  CostStudy study = study_of("kepler", {"rattle"}, 12);
  const auto longest = [&] {
    long most = 0;
    for (const CostCell& cell : cost_grid(study, gentle)) most = std::max(most, cell.steps);
    return most;
  };
  study.most_seconds = 1;
  const long in_a_second = longest();
  study.most_seconds = 0.01;
  EXPECT_LT(longest(), in_a_second / 20);
  EXPECT_GT(longest(), 0);
}

TEST(CostGrid, HasMoreStepsForFewerStages) {
  const CostStudy study = study_of("kepler", {"hbvm:2,2", "hbvm:8,8"}, 14);
  std::map<std::string, long> most;
  for (const CostCell& cell : cost_grid(study, gentle))
    most[cell.method->text()] = std::max(most[cell.method->text()], cell.steps);
  EXPECT_GT(most["hbvm:2,2"], 20 * most["hbvm:8,8"]);
}

TEST(CostPrecisions, ReachTheDigitsAndNoFurther) {
  const auto names = [](double digits) {
    std::vector<std::string> result;
    for (const Precision& p : default_precisions(digits, gentle)) result.push_back(p.name());
    return result;
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(names(10), Names{"double"});
  EXPECT_EQ(names(25), (Names{"double", "quad", "mpfr:29"}));
  EXPECT_EQ(names(100), (Names{"double", "quad", "mpfr:34", "mpfr:54", "mpfr:104"}));
  // A motion that magnifies errors needs more.
  EXPECT_EQ(default_precisions(50, {20, 0}).back().name(), "mpfr:73");
}

}  // namespace
}  // namespace hbvm::core

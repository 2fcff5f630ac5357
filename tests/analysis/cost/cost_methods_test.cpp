#include "hbvm/analysis/cost/cost_methods.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "hbvm/error.hpp"
#include "hbvm/reference/taylor_method.hpp"

namespace hbvm {
namespace {

std::vector<std::string> names_of(const std::vector<MethodPtr>& methods) {
  std::vector<std::string> names;
  for (const MethodPtr& method : methods) names.push_back(method->text());
  return names;
}

bool holds(const std::vector<MethodPtr>& methods, const char* name) {
  const std::vector<std::string> names = names_of(methods);
  return std::find(names.begin(), names.end(), name) != names.end();
}

TEST(CostMethods, HaveMoreStagesForMoreDigits) {
  EXPECT_FALSE(holds(cost_methods({"gauss"}, 10), "hbvm:48,48"));
  EXPECT_TRUE(holds(cost_methods({"gauss"}, 100), "hbvm:48,48"));
  EXPECT_FALSE(holds(cost_methods({"gauss"}, 100), "hbvm:40,40"));
  EXPECT_TRUE(holds(cost_methods({"gauss"}, 100, Choice::dense), "hbvm:40,40"));
}

TEST(CostMethods, AreThoseOfAListEachOnce) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(names_of(cost_methods({"hbvm:5,3", "rattle", "hbvm:5,3", "lobatto:4"}, 20)),
            (Names{"hbvm:5,3", "rattle", "lobatto:4"}));
}

TEST(CostMethods, AreAllFamiliesWithoutAList) {
  const std::vector<MethodPtr> all = cost_methods({}, 20);
  for (const char* const name : {"hbvm:1,1", "hbvm:auto,3", "rattle", "compose:rattle,4", "lobatto:3"})
    EXPECT_TRUE(holds(all, name)) << name;
}

/// Its errors do not follow from the step, and its number types may be fewer.
TEST(CostMethods, LeaveOutWhatDividesItsStepsUnlessItIsAskedFor) {
  add_taylor_method();
  EXPECT_FALSE(holds(cost_methods({}, 20), "taylor"));
  EXPECT_TRUE(holds(cost_methods({"taylor"}, 20), "taylor"));
  EXPECT_TRUE(holds(cost_methods({"bulirsch_stoer:12"}, 20), "bulirsch_stoer:12"));
}

TEST(CostMethods, RefuseWhatIsNone) {
  try {
    cost_methods({"gaus"}, 20);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("'gauss'"), std::string::npos) << error.what();
  }
  EXPECT_THROW(cost_methods({"hbvm:2,3"}, 20), InputError);
}

}  // namespace
}  // namespace hbvm

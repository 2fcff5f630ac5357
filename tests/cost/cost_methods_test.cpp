#include "cost/cost_methods.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "hbvm/error.hpp"
#include "reference/taylor_method.hpp"
#include "step/registry.hpp"
#include "words.hpp"

namespace hbvm::core {
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
  add_taylor_method();
  const std::vector<MethodPtr> all = cost_methods({}, 20);
  for (const char* const name :
       {"hbvm:1,1", "hbvm:auto,3", "rattle", "compose:rattle,4", "lobatto:3", "energy_momentum", "projected_hbvm:4,4",
        "restored_hbvm:4,4", "rkf78", "bulirsch_stoer:10", "taylor"})
    EXPECT_TRUE(holds(all, name)) << name;
}

TEST(CostMethods, AreMembersOfAFamilyByItsName) {
  for (const char* const family : {"projected_hbvm", "restored_hbvm", "bulirsch_stoer"}) {
    const std::vector<MethodPtr> members = cost_methods({family}, 20);
    EXPECT_GT(members.size(), 3u) << family;
    for (const MethodPtr& member : members) EXPECT_TRUE(member->text().starts_with(family)) << member->text();
    EXPECT_LT(cost_methods({family}, 5).size(), members.size()) << family;
  }
}

TEST(CostMethods, SuitThePrecisionsThatHaveTheirDigits) {
  add_taylor_method();
  const MethodPtr extrapolation = parse_method("bulirsch_stoer:20"), taylor = parse_method("taylor");
  EXPECT_FALSE(suits(*extrapolation, Precision::parse("double")));
  EXPECT_TRUE(suits(*extrapolation, Precision::parse("quad")));
  EXPECT_FALSE(suits(*extrapolation, Precision::parse("mpfr:200")));
  EXPECT_TRUE(suits(*taylor, Precision::parse("mpfr:20")));
  EXPECT_TRUE(suits(*parse_method("rattle"), Precision::parse("double")));
}

TEST(CostMethods, RefuseWhatIsNone) {
  expect_words(message_of([&] { cost_methods({"gaus"}, 20); }), {"'gauss'"});
  EXPECT_THROW(cost_methods({"hbvm:2,3"}, 20), InputError);
}

}  // namespace
}  // namespace hbvm::core

#include <gtest/gtest.h>

#include <algorithm>

#include "door/door.hpp"
#include "hbvm/error.hpp"
#include "hbvm/method.hpp"
#include "method/runge_kutta.hpp"

namespace hbvm {
namespace {

TEST(DoorMethod, KnowsAllFamilies) {
  const std::vector<MethodKind> kinds = methods();
  for (const char* const name : {"hbvm", "rattle", "taylor"})
    EXPECT_TRUE(std::any_of(kinds.begin(), kinds.end(), [&](const MethodKind& k) { return k.name == name; })) << name;
}

TEST(DoorMethod, TellsWhatIsKnown) {
  const MethodFacts facts = method_facts("hbvm:4,2");
  EXPECT_EQ(facts.title, "HBVM(4,2)");
  EXPECT_EQ(facts.order, 4);
  EXPECT_EQ(facts.stages, 2);
  EXPECT_TRUE(facts.keeps_energy);
  EXPECT_FALSE(method_facts("rattle").keeps_energy);
  EXPECT_THROW(method_facts("nothing"), InputError);
}

TEST(DoorMethod, TableausHaveTheRowSumsIfNoNodesAreGiven) {
  const Tableau tableau = core::completed({.name = "midpoint", .A = {{"1/4", "1/4"}, {0.5, 0}}, .b = {1, 0}, .c = {}});
  EXPECT_EQ(core::make_runge_kutta<double>(tableau).c[0], 0.5);
  EXPECT_THROW(core::completed({.name = "x", .A = {{1}}, .b = {1, 2}, .c = {}}), InputError);
  EXPECT_THROW(core::completed({.name = "x", .A = {{"1/"}}, .b = {1}, .c = {}}), InputError);
  EXPECT_THROW(read_tableau("/nowhere.toml"), InputError);
}

}  // namespace
}  // namespace hbvm

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

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

/// The list says of each what a run finds: Gauss keeps what is quadratic, Verlet is another name.
TEST(DoorMethod, ListsWhatTheyKeep) {
  const nlohmann::json list = nlohmann::json::parse(to_json(methods())).at("methods");
  EXPECT_EQ(list.size(), methods().size());
  const auto of = [&](const char* name) {
    return *std::find_if(list.begin(), list.end(), [&](const nlohmann::json& one) { return one.at("name") == name; });
  };
  EXPECT_EQ(of("hbvm").at("form"), "hbvm:K,S");
  EXPECT_EQ(of("hbvm").at("order"), "2S");
  EXPECT_EQ(of("rattle").at("keeps"), "momenta, both constraints, reversal");
  EXPECT_EQ(of("rk4").at("keeps"), "");
  EXPECT_EQ(of("verlet").at("is"), "rattle");
  EXPECT_FALSE(of("verlet").contains("order"));
  const std::string text = to_text(methods());
  for (const MethodKind& kind : methods()) EXPECT_NE(text.find(kind.form), std::string::npos) << kind.form;
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

#include <gtest/gtest.h>

#include "cli/json.hpp"
#include "cli/program.hpp"

namespace hbvm::core {
namespace {

using Json = nlohmann::json;

/// Each name in the list runs, by itself or with the number that its form asks for.
TEST(Methods, ListsOnlyMethodsThatRun) {
  const Json methods = Json::parse(ended_with(0, {"methods", "--json"}).out).at("methods");
  EXPECT_GT(methods.size(), 10u);
  for (const Json& method : methods) {
    const std::string form = method.at("form");
    if (form.find(':') == std::string::npos && form != "taylor")
      ended_with(0, run_of("kepler", form.c_str(), "1/64", "1/64"));
  }
  ended_with(0, run_of("kepler", "gauss:3", "1/64", "1/64"));
  ended_with(0, run_of("kepler", "radau:3", "1/64", "1/64"));
}

TEST(Methods, AreATableOfNamesOrdersAndWork) {
  const Outcome outcome = ended_with(0, {"methods"});
  EXPECT_EQ(outcome.err, "");
  for (const char* const word : {"hbvm:K,S", "2S-1", "energy", "verlet", "Other names"})
    EXPECT_NE(outcome.out.find(word), std::string::npos) << word;
}

}  // namespace
}  // namespace hbvm::core

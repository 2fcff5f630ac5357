#include <nlohmann/json.hpp>

#include "cli/program.hpp"
#include "folder.hpp"

namespace hbvm::core {
namespace {

TEST(TangentCommand, PrintsExponents) {
  const Arguments arguments{"tangent", "henon_heiles", "--method", "hbvm:4,4", "--step", "1/4", "--until", "10"};
  expect_words(ended_with(0, arguments).out, {"Lyapunov exponents", "digits are lost", "the 2-form"});
  const Folder folder;
  ended_with(0, arguments + Arguments{"--plot", folder / "exponents.svg"});
  expect_words(text_of(folder.path() / "exponents.svg"), {"Mean rates of growth", "Digits lost"});
  const auto json = nlohmann::json::parse(ended_with(0, arguments + Arguments{"--json"}).out);
  EXPECT_EQ(json.at("names").size(), json.at("end").size());
  expect_refused({"tangent", "henon_heiles", "--until", "10", "--constants", "none"}, {"no constant 'none'"});
  expect_refused({"tangent", "henon_heiles", "--step", "1", "--until", "2"}, {"ten steps"});
}

}  // namespace
}  // namespace hbvm::core

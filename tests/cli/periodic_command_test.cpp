#include <nlohmann/json.hpp>

#include "cli/program.hpp"
#include "folder.hpp"

namespace hbvm::core {
namespace {

/// What it prints is a start, from which a run comes back.
TEST(PeriodicCommand, PrintsAStart) {
  const Folder folder;
  const std::string text = ended_with(0, {"periodic", "henon_heiles", "--until", "8", "--json"}).out;
  folder.write("orbit.json", text);
  const auto orbit = nlohmann::json::parse(text);
  const std::string period = orbit.at("period");
  const auto run =
      nlohmann::json::parse(ended_with(0, {"run", "henon_heiles", "--start", folder / "orbit.json", "--method",
                                           "hbvm:6,6", "--step", period + "/100", "--until", period, "--json"})
                                .out);
  for (const std::size_t n : {0u, 1u})
    EXPECT_NEAR(std::stod(run.at("q").at(n).get<std::string>()), std::stod(orbit.at("q").at(n).get<std::string>()),
                1e-11);
  expect_refused({"periodic", "henon_heiles", "--until", "8", "--digits", "0"}, {"1 to 1000 digits"});
}

}  // namespace
}  // namespace hbvm::core

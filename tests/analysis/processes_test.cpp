#include "analysis/processes.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <stdexcept>

namespace hbvm {
namespace {

TEST(InProcesses, TellsResultsFromWhatWasLost) {
  const std::vector<WorkCell> cells{{"a", [] { return std::string("\"one\""); }},
                                    {"b", []() -> std::string { throw std::runtime_error("odd"); }},
                                    {"c",
                                     []() -> std::string {
                                       std::raise(SIGKILL);
                                       return "";
                                     }},
                                    {"d", [] { return std::string("\"four\""); }}};
  CellOptions options;
  options.jobs = 3;
  const auto results = run_cells(cells, options,
                                 in_processes(
                                     cells, options.jobs, [](std::size_t) { return 10.; },
                                     [](std::size_t i, const ProcessEnd& end) {
                                       return end.failure.empty() ? end.text : std::to_string(i) + end.failure;
                                     }));
  EXPECT_EQ(*results[0], "\"one\"");
  EXPECT_EQ(*results[1], "1an exception: odd");
  EXPECT_TRUE(results[2]->starts_with("2")) << *results[2];
  EXPECT_EQ(*results[3], "\"four\"");
}

}  // namespace
}  // namespace hbvm

#include "processes/in_processes.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <stdexcept>

#include "interrupting.hpp"

namespace hbvm::core {
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

/// What a cell says that a signal ended is no result.
TEST(InProcesses, EndWithASignalAndKeepWhatWasDoneBefore) {
  std::vector<WorkCell> cells;
  for (const char* const key : {"a", "b", "c"})
    cells.push_back({key, [] {
                       if (interruption != 0) throw Interrupted(SIGINT, "x");
                       return std::string("1");
                     }});
  CellStore store;
  CellOptions options;
  options.store = &store;
  options.progress = [](long done, long) {
    if (done == 1) interruption = SIGINT;
  };
  EXPECT_THROW(run_cells(cells, options,
                         in_processes(
                             cells, 1, [](std::size_t) { return 10.; },
                             [](std::size_t, const ProcessEnd& end) {
                               return end.failure.empty() ? end.text : "\"" + end.failure + "\"";
                             })),
               Interrupted);
  interruption = 0;
  ASSERT_TRUE(store.find("a"));
  EXPECT_EQ(*store.find("a"), "1");
  EXPECT_FALSE(store.find("b"));
  EXPECT_FALSE(store.find("c"));
}

}  // namespace
}  // namespace hbvm::core

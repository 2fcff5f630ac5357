#include "cost/cost_study.hpp"

#include <gtest/gtest.h>

#include "cost/cost_methods.hpp"
#include "hbvm/error.hpp"
#include "processes/in_processes.hpp"

namespace hbvm::core {
namespace {

CostStudy small_study(const char* scene) {
  CostStudy study{load_scene(scene), Expression::parse("10")};
  study.most_digits = 12;
  study.methods = cost_methods({"rattle", "hbvm:4,4"}, 12);
  study.most_seconds = 0.01;
  return study;
}

/// All of a finding that is no time.
std::string timeless(const CostFinding& f) {
  const CostMeasurement& m = f.measured;
  return f.cell.key() + " " + m.method + " " + std::to_string(m.errors.q) + " " + std::to_string(m.raw.p) + " " +
         std::to_string(m.sweeps) + " " + std::to_string(m.operations) + m.failure;
}

TEST(CostStudy, IsTheSameInShardsPutTogether) {
  const CostStudy study = small_study("double_pendulum");
  CostOptions alone;
  alone.jobs = 2;
  alone.apart = in_processes;
  const CostOutcome whole = run_cost_study(study, alone);
  EXPECT_EQ(whole.findings.size(), whole.cells);
  EXPECT_GT(whole.cells, 8u);

  CellStore store;
  std::size_t most = 0;
  for (int i = 1; i <= 5; ++i) {
    CostOptions part;
    part.shard = {i, 5};
    part.store = &store;
    if (i > 1) part.apart = in_processes;  // the first without: it finds the same
    most = run_cost_study(study, part).findings.size();
  }
  EXPECT_EQ(most, whole.cells);
  // All are known now, and none is run: signals and clocks have no part in it.
  CostOptions again;
  again.store = &store;
  again.progress = [&](long done, long total) { EXPECT_EQ(done, total); };
  const CostOutcome merged = run_cost_study(study, again);
  ASSERT_EQ(merged.findings.size(), whole.findings.size());
  for (std::size_t i = 0; i < whole.findings.size(); ++i)
    EXPECT_EQ(timeless(merged.findings[i]), timeless(whole.findings[i]));
}

TEST(CostStudy, RefusesMultipliersOfAFreeMotion) {
  CostStudy study = small_study("kepler");
  study.quantity = CostQuantity::lambda;
  EXPECT_THROW(run_cost_study(study, {}), InputError);
}

}  // namespace
}  // namespace hbvm::core

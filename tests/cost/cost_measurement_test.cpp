#include <gtest/gtest.h>

#include <cmath>

#include "cost/cost_cell.hpp"
#include "hbvm/error.hpp"

namespace hbvm::core {
namespace {

TEST(CostMeasurement, ReadsBackFromItsResult) {
  CostMeasurement m;
  m.method = "hbvm:4,4";
  m.errors = {-3.25, -1e-9, std::nan("")};
  m.raw = {-3.25, -2, std::nan("")};
  m.at_reference = true;
  m.seconds = 0.1;
  m.spread = 0.03;
  m.calibration = 0.001;
  m.repetitions = 7;
  m.disturbed = 2;
  m.setup_seconds = 0.2;
  m.sweeps = 123;
  m.evaluations = 456;
  m.operations = 1ULL << 60;
  m.operations_in_double = 11;
  m.bytes = 4096;
  m.account_steps = 8;
  m.account = {{"gravity", AccountLine::Kind::effect}, {"factors", AccountLine::Kind::in_double}};
  m.account[1].seconds = 0.25;
  const CostMeasurement again = read_cost_measurement(to_result(m));
  EXPECT_EQ(to_result(again), to_result(m));
  EXPECT_EQ(again.errors.p, -1e-9);
  EXPECT_TRUE(std::isnan(again.errors.lambda));
  EXPECT_EQ(again.operations, m.operations);
  EXPECT_EQ(again.account[1].kind, AccountLine::Kind::in_double);
  EXPECT_EQ(again.account[1].seconds, 0.25);
}

TEST(CostMeasurement, OfAFailureIsItsReason) {
  CostMeasurement m;
  m.method = "rattle";
  m.failure = "no end";
  EXPECT_EQ(read_cost_measurement(to_result(m)).failure, "no end");
}

TEST(CostMeasurement, RefusesWhatIsNone) {
  EXPECT_THROW(read_cost_measurement("{}"), InputError);
  EXPECT_THROW(read_cost_measurement("nothing"), InputError);
}

}  // namespace
}  // namespace hbvm::core

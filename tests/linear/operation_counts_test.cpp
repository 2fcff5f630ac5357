#include "linear/operation_counts.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace hbvm::core {
namespace {

TEST(OperationCounts, StartAtZero) {
  const OperationCounts counts;
  for (std::size_t op = 0; op < op_count; ++op) EXPECT_EQ(counts[static_cast<Op>(op)], 0u);
  EXPECT_EQ(counts.total(), 0u);
}

TEST(OperationCounts, AddAndMultiply) {
  OperationCounts a, b;
  a.add_products(3);
  a.add(Op::sqrt, 2);
  b.add(Op::sqrt, 5);
  b[Op::log] = 1;
  const OperationCounts sum = a + b;
  EXPECT_EQ(sum[Op::multiply], 3u);
  EXPECT_EQ(sum[Op::add], 3u);
  EXPECT_EQ(sum[Op::sqrt], 7u);
  EXPECT_EQ(sum[Op::log], 1u);
  EXPECT_EQ(sum.total(), 14u);
  EXPECT_EQ((3 * sum).total(), 42u);
  EXPECT_EQ(3 * sum, sum + sum + sum);
  EXPECT_NE(a, b);
}

TEST(OperationCounts, EveryOperationHasItsName) {
  std::set<std::string> names;
  for (std::size_t op = 0; op < op_count; ++op) names.insert(name_of(static_cast<Op>(op)));
  EXPECT_EQ(names.size(), op_count);
  EXPECT_EQ(name_of(Op::add), std::string("add"));
  EXPECT_EQ(name_of(Op::log), std::string("log"));
}

}  // namespace
}  // namespace hbvm::core

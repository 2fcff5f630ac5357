#include "cost/pareto.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hbvm::core {
namespace {

using Places = std::vector<std::size_t>;

TEST(Pareto, LeavesWhatNothingBeatsInBoth) {
  EXPECT_EQ(pareto_front({{3, -5}, {1, -2}, {2, -1}, {4, -5}, {2, -3}}), (Places{1, 4, 0}));
  EXPECT_EQ(pareto_front({}), Places{});
}

TEST(Pareto, TakesOneOfEqualPoints) { EXPECT_EQ(pareto_front({{1, -2}, {1, -2}, {1, -1}}).size(), 1u); }

TEST(Pareto, LeavesOutWhatIsNotFinite) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(pareto_front({{1, -infinity}, {NAN, -9}, {2, NAN}, {3, -1}}), Places{3});
}

}  // namespace
}  // namespace hbvm::core

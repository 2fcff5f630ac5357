#include "integrate/energy_change.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "printing.hpp"

namespace hbvm::core {
namespace {

struct MeshPoint {
  double kinetic, error;
};

template <class S>
typename EnergyChange<S>::Change change_of(const std::vector<MeshPoint>& path, int sign = 1) {
  EnergyChange<S> energy;
  long n = 0;
  for (const MeshPoint& point : path) energy.observe(S(point.kinetic), S(point.error), S(sign * n++));
  return energy.change();
}

template <class S>
class Energy : public InDigits<50> {};
TYPED_TEST_SUITE(Energy, AllScalars, ScalarNames);

TYPED_TEST(Energy, HasChangedWhereItIsOffByMoreThanATwentieth) {
  const auto change = change_of<TypeParam>({{1, 0}, {1, 0.01}, {1, -0.3}, {1, 0.4}, {1, 0.2}});
  EXPECT_EQ(change.error, TypeParam(double{0.4}));
  EXPECT_EQ(change.t, 2);
  EXPECT_EQ(change.usual, 2) << "1 lies in 1 .. 2";
  EXPECT_EQ(change_of<TypeParam>({{1, 0}, {1, 0.04}, {1, -0.04}}).error, 0);
}

/// Forwards or backwards in time.
TYPED_TEST(Energy, HasChangedSinceTheFirstTime) {
  EXPECT_EQ(change_of<TypeParam>({{1, 0}, {1, 0.3}, {1, 0.3}, {1, 0.4}}, -1).t, -1);
}

TYPED_TEST(Energy, OfAPericentreIsTheErrorThere) {
  // Most of the time 1, a thousand once: an error of 1 is small there, and much where it lasts.
  EXPECT_EQ(change_of<TypeParam>({{1, 0}, {1, 0}, {1000, 1}, {1, 0}, {1, 0}}).error, 0);
  EXPECT_EQ(change_of<TypeParam>({{1, 0}, {1, 0}, {1000, 1}, {1, 1}, {1, 1}}).t, 3);
}

TYPED_TEST(Energy, OfATurningPointIsNotLost) {
  EXPECT_EQ(change_of<TypeParam>({{0, 0}, {1, 1e-3}, {1, 1e-3}, {0, 1e-3}, {1, 1e-3}}).error, 0);
}

TYPED_TEST(Energy, OfRestIsAnyError) {
  const auto change = change_of<TypeParam>({{0, 0}, {0, 0}, {0, 1e-9}});
  EXPECT_GT(change.error, 0);
  EXPECT_EQ(change.usual, 0);
  EXPECT_EQ(change_of<TypeParam>({{0, 0}, {0, 0}}).error, 0);
}

TYPED_TEST(Energy, IsRemembered) {
  using S = TypeParam;
  EnergyChange<S> first, second;
  first.observe(S(1), S(0), S(0));
  first.observe(S(1), S(1), S(1));
  Archive written;
  written(first);
  Archive read(written.text());
  read(second);
  for (auto* energy : {&first, &second}) energy->observe(S(4), S(2), S(2));
  EXPECT_EQ(second.change().t, 1);
  EXPECT_EQ(second.change().error, 2);
  EXPECT_EQ(second.change().usual, first.change().usual);
}

}  // namespace
}  // namespace hbvm::core

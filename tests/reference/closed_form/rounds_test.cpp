#include "reference/closed_form/rounds.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "interrupting.hpp"

namespace hbvm::core {
namespace {

TEST(Rounds, AreNoMoreThanTheoryAllows) {
  Rounds rounds("a sum", 2.5);
  for (int n = 0; n < 3; ++n) EXPECT_NO_THROW(rounds.next());
  EXPECT_THROW(rounds.next(), IntegrationError);
  Rounds none("a sum", std::numeric_limits<double>::quiet_NaN());
  EXPECT_THROW(none.next(), IntegrationError);
}

TEST(Rounds, EndWithASignal) {
  Rounds rounds("a sum", 10);
  interruption = 15;
  EXPECT_THROW(rounds.next(), Interrupted);
  interruption = 0;
  EXPECT_NO_THROW(rounds.next());
}

}  // namespace
}  // namespace hbvm::core

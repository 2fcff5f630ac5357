#include "solver/stage_failure.hpp"

#include <gtest/gtest.h>

#include <set>

namespace hbvm::core {
namespace {

constexpr FailureCause causes[] = {FailureCause::stage_equations_diverge, FailureCause::near_singular_constraints,
                                   FailureCause::precision_exhausted, FailureCause::inconsistent_state};

/// JSON and the collection of hard cases hold these names.
TEST(FailureCauses, HaveNamesThatStay) {
  EXPECT_EQ(name_of(FailureCause::stage_equations_diverge), "stage_equations_diverge");
  EXPECT_EQ(name_of(FailureCause::near_singular_constraints), "near_singular_constraints");
  EXPECT_EQ(name_of(FailureCause::precision_exhausted), "precision_exhausted");
  EXPECT_EQ(name_of(FailureCause::inconsistent_state), "inconsistent_state");
}

TEST(FailureCauses, SayWhatToDo) {
  std::set<std::string_view> remedies;
  for (const FailureCause cause : causes) remedies.insert(remedy_of(cause));
  EXPECT_EQ(remedies.size(), std::size(causes));
  EXPECT_NE(remedy_of(FailureCause::stage_equations_diverge).find("smaller step"), std::string_view::npos);
  EXPECT_NE(remedy_of(FailureCause::near_singular_constraints).find("more digits"), std::string_view::npos);
  EXPECT_NE(remedy_of(FailureCause::precision_exhausted).find("more digits"), std::string_view::npos);
  EXPECT_NE(remedy_of(FailureCause::inconsistent_state).find("hbvm scene project"), std::string_view::npos);
}

TEST(FailureCauses, AreThoseOfTheFailure) {
  for (const FailureCause cause : causes) {
    const StageFailure failure(cause, "what was seen", "1e-3", 17);
    EXPECT_EQ(failure.cause(), cause);
    EXPECT_EQ(failure.sweeps(), 17);
    EXPECT_EQ(failure.increment(), "1e-3");
    EXPECT_STREQ(failure.what(), "what was seen");
  }
}

}  // namespace
}  // namespace hbvm::core

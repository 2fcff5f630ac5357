#include "integrate/step_error.hpp"

#include "words.hpp"

namespace hbvm::core {
namespace {

TEST(StepErrors, SayWhatWhereAndWhatToDo) {
  const StageFailure failure(FailureCause::stage_equations_diverge, "the increments grow", "3.14e-2", 17);
  const StepError error(123, "4.5", failure);
  EXPECT_STREQ(error.what(),
               "step 123 from t = 4.5: stage_equations_diverge: the increments grow after 17 sweeps, last increment "
               "3.14e-2 of the unknowns; try a smaller step");
  EXPECT_EQ(error.cause(), FailureCause::stage_equations_diverge);
  EXPECT_EQ(error.step(), 123);
  EXPECT_EQ(error.time(), "4.5");
  EXPECT_EQ(error.increment(), "3.14e-2");
}

TEST(StepErrors, TakeOtherAdvice) {
  const StepError error(7, "2", StageFailure(FailureCause::near_singular_constraints, "x", "0", 1));
  const StepError other(error, "take a smaller step");
  EXPECT_STREQ(other.what(),
               "step 7 from t = 2: near_singular_constraints: x after 1 sweeps, last increment 0 of the unknowns; take "
               "a smaller step");
  EXPECT_EQ(other.cause(), error.cause());
  EXPECT_EQ(other.step(), 7);
  EXPECT_EQ(other.time(), "2");
}

/// The program exits with 3, and scripts look for the cause.
TEST(StepErrors, AreIntegrationErrorsOfTheirCause) {
  for (const FailureCause cause :
       {FailureCause::near_singular_constraints, FailureCause::precision_exhausted, FailureCause::inconsistent_state}) {
    const std::string text =
        message_of<IntegrationError>([&] { throw StepError(1, "0", StageFailure(cause, "x", "0", 1)); });
    expect_words(text, {std::string(name_of(cause))});
    EXPECT_TRUE(text.ends_with(remedy_of(cause))) << text;
  }
}

}  // namespace
}  // namespace hbvm::core

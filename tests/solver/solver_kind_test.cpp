#include "solver/solver_kind.hpp"

#include <gtest/gtest.h>

#include <string>

#include "hbvm/error.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

TEST(SolverKinds, AreReadByTheirNames) {
  EXPECT_EQ(parse_solver("auto"), SolverKind::automatic);
  EXPECT_EQ(parse_solver("newton"), SolverKind::newton);
  EXPECT_EQ(parse_solver("fixed-point"), SolverKind::fixed_point);
  EXPECT_EQ(parse_solver("paper"), SolverKind::paper);
  for (const SolverKind kind : {SolverKind::automatic, SolverKind::newton, SolverKind::fixed_point, SolverKind::paper})
    EXPECT_EQ(parse_solver(name_of(kind)), kind);
}

TEST(SolverKinds, UnknownAreRefusedWithTheKnown) {
  for (const char* const unknown : {"", "Newton", "automatic", "fixed_point", "newton "}) {
    try {
      parse_solver(unknown);
      ADD_FAILURE() << unknown;
    } catch (const InputError& error) {
      const std::string message = error.what();
      expect_words(message, {"auto", "newton", "fixed-point", "paper"});
      EXPECT_NE(message.find("'" + std::string(unknown) + "'"), std::string::npos) << message;
    }
  }
}

}  // namespace
}  // namespace hbvm::core

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
  EXPECT_EQ(name_of(SolverKind::paper), "paper");
  for (const SolverKind kind : {SolverKind::automatic, SolverKind::newton, SolverKind::fixed_point, SolverKind::paper})
    EXPECT_EQ(parse_solver(name_of(kind)), kind);
}

TEST(SolverKinds, UnknownAreRefusedWithTheKnown) {
  for (const std::string unknown :
       {"", "Newton", "automatic", "fixed_point", "newton ", "Paper", "newtonian", "paper "})
    expect_words(message_of([&] { parse_solver(unknown); }),
                 {"auto", "newton", "fixed-point", "paper", "'" + unknown + "'"});
}

}  // namespace
}  // namespace hbvm::core

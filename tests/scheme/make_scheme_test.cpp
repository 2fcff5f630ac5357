#include <gtest/gtest.h>

#include "scheme/tables.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

TEST(SchemeFamilies, AreToldByTheirArrays) {
  EXPECT_EQ(scheme_of(fehlberg)->family(), "runge_kutta");
  EXPECT_EQ(scheme_of(lobatto_pair)->family(), "partitioned");
  EXPECT_EQ(scheme_of(nystrom_4)->family(), "nystrom");
  EXPECT_EQ(scheme_of(forest_ruth)->family(), "splitting");
  EXPECT_EQ(scheme_of(yoshida_6)->family(), "composition");
  EXPECT_EQ(scheme_of(calahan)->family(), "rosenbrock");
  EXPECT_EQ(scheme_of("alpha = [-1, 1]\nbeta = [1, 0]\n")->family(), "multistep");
}

TEST(SchemeFamilies, RefuseWhatIsNone) {
  const auto refusal = [](const std::string& text) { return message_of([&] { scheme_of(text); }); };
  expect_words(refusal("family = 'spliting'\na = [1]\nb = [1]\n"), {"'spliting'", "did you mean 'splitting'"});
  expect_words(refusal("q = [1]\n"), {"no family", "runge_kutta", "multistep"});
  expect_words(refusal("A = [[0]]\nb = [1]\nb_hatt = [1]\n"), {"'b_hatt'", "b_hat"});
  expect_words(refusal("family = 'nystrom'\nA = [[0]]\nb = [1]\n"), {"'c' is missing"});
}

}  // namespace
}  // namespace hbvm::core

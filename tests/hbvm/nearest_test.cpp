#include "nearest.hpp"

#include <gtest/gtest.h>

namespace hbvm::core {
namespace {

TEST(Nearest, IsTheWordOfTheFewestEdits) {
  EXPECT_EQ(nearest("lenght", {"length", "weight", "mass"}), "length");
  EXPECT_EQ(nearest("mas", {"mars", "mass", "mas"}), "mas");
  EXPECT_EQ(nearest("abcd", {"abxy"}), "abxy") << "half of it";
  EXPECT_EQ(nearest("abcd", {"axyz"}), "");
  EXPECT_EQ(nearest("x", {}), "");
}

TEST(Nearest, IsAskedForOnlyIfThereIsOne) {
  EXPECT_EQ(did_you_mean("runn", {"nodes", "run"}), ": did you mean 'run'?");
  EXPECT_EQ(did_you_mean("zzz", {"nodes", "run"}), "");
}

TEST(Nearest, ListsAllThereAre) {
  EXPECT_EQ(did_you_mean_or_list("runn", {"nodes", "run"}), ": did you mean 'run'? There are nodes, run");
  EXPECT_EQ(did_you_mean_or_list("zzz", {"nodes", "run"}), "; there are nodes, run");
}

}  // namespace
}  // namespace hbvm::core

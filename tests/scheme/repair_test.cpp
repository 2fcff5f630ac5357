#include "scheme/repair.hpp"

#include <gtest/gtest.h>

#include "scheme/tables.hpp"

namespace hbvm::core {
namespace {

Repair repair(const std::string& text, const std::vector<int>& targets, int most = 2) {
  const SchemePtr scheme = scheme_of(text);
  const Rounding rounding = Rounding::of(*scheme, {});
  const PrecisionScope scope(rounding.working_digits);
  return repair_of(*scheme, rounding, targets, most);
}

std::string with(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

/// "ENTRY EXACT" of the only way there must be.
std::vector<std::string> only_way(const std::string& text, const std::vector<int>& targets, int most = 2) {
  const Repair found = repair(text, targets, most);
  EXPECT_EQ(found.ways.size(), 1u);
  std::vector<std::string> way;
  if (found.ways.size() != 1) return way;
  for (const MendedEntry& mended : found.ways[0])
    way.push_back(scheme_of(text)->entries()[mended.entry].name + " " + mended.exact);
  return way;
}

TEST(Repairs, FindOneWrongEntryOfAPair) {
  EXPECT_EQ(only_way(with(fehlberg, "-3544/2565", "-3554/2565"), {5, 4}),
            (std::vector<std::string>{"A[6][3] -3544/2565"}));
  EXPECT_EQ(only_way(with(fehlberg, "2197/4104", "2179/4104"), {5, 4}),
            (std::vector<std::string>{"b_hat[4] 2197/4104"}));
  EXPECT_EQ(only_way(with(fehlberg, "12/13", "12/31"), {5, 4}), (std::vector<std::string>{"c[4] 12/13"}));
}

TEST(Repairs, FindOneThatHidesBehindAnother) {
  EXPECT_EQ(only_way(with(with(fehlberg, "-3544/2565", "-3554/2565"), "1932/2197", "1923/2197"), {5, 4}),
            (std::vector<std::string>{"A[4][1] 1932/2197", "A[6][3] -3544/2565"}));
}

TEST(Repairs, FindWhatIsUnknown) {
  EXPECT_EQ(only_way(with(fehlberg, "'-3544/2565'", "'?'"), {5, 4}), (std::vector<std::string>{"A[6][3] -3544/2565"}));
  EXPECT_EQ(only_way(with(calahan, "'1/4'", "'?'"), {3}), (std::vector<std::string>{"b[1] 1/4"}));
}

TEST(Repairs, OfOtherFamilies) {
  EXPECT_EQ(only_way(with(nystrom_4, "1/8", "1/9"), {4}), (std::vector<std::string>{"A[2][1] 1/8"}));
  EXPECT_EQ(only_way(with(lobatto_pair, "5/24", "5/42"), {4, 4}), (std::vector<std::string>{"A[2][1] 5/24"}));
  EXPECT_EQ(only_way("alpha = [-1,0,1]\nbeta = ['1/3','3/4','1/3']\n", {4}), (std::vector<std::string>{"beta[2] 4/3"}));
}

/// Fifteen digits are mended to fifteen.
TEST(Repairs, OfDecimalsHaveTheirDigits) {
  const Repair found = repair(
      with(yoshida_6, "0.235573213359357, -1.17767998417887, '1-2", "0.235537213359357, -1.17767998417887, '1-2"), {6});
  ASSERT_EQ(found.ways.size(), 1u);
  EXPECT_EQ(found.ways[0][0].value.substr(0, 14), "2.355732133593");
  EXPECT_EQ(found.ways[0][0].exact, "");
}

TEST(Repairs, SayNothingThatIsNotDetermined) {
  // Any a makes a method of order 2 with its own weights.
  EXPECT_TRUE(repair("A = [[0,0],['?',0]]\nb = ['?','?']\n", {2}).ways.empty());
  // Four conditions and three unknowns, one of which is free: the node c_2 of Heun's third order method.
  EXPECT_TRUE(repair("A = [[0,0,0],['?',0,0],['?','?',0]]\nb = ['1/4',0,'3/4']\n", {3}).ways.empty());
  // A right one is not changed.
  EXPECT_TRUE(repair(fehlberg, {5, 4}, 1).ways.empty());
  // Order 6 is out of its reach.
  EXPECT_TRUE(repair(fehlberg, {6, 4}, 1).ways.empty());
}

}  // namespace
}  // namespace hbvm::core

#include <nlohmann/json.hpp>

#include "folder.hpp"
#include "hbvm/error.hpp"
#include "hbvm/scheme.hpp"
#include "scheme/tables.hpp"
#include "words.hpp"

namespace hbvm {
namespace {

const std::string with_typo = [] {
  std::string text = core::fehlberg;
  return text.replace(text.find("-3544/2565"), 10, "-3554/2565");
}();

SchemeAudit audited(const std::string& text, SchemeRequest request = {}) {
  const core::Folder folder;
  request.file = folder.write("mine.toml", text);
  return audit_scheme(request);
}

TEST(DoorSchemes, FindTheWrongEntryWhateverIsClaimed) {
  for (const std::string& claimed : {std::string(), std::string("order = 5\nembedded_order = 4\n")}) {
    const SchemeAudit found = audited(claimed + with_typo);
    EXPECT_FALSE(found.holds);
    ASSERT_EQ(found.repair.size(), 1u);
    EXPECT_EQ(found.repair[0].entry, "A[6][3]");
    EXPECT_EQ(found.repair[0].exact, "-3544/2565");
    EXPECT_EQ(found.repair[0].printed, "-3554/2565");
    EXPECT_EQ(found.conditions, 17 + 8 + 6);
    // What is written as mended holds.
    const SchemeAudit again = audited(found.mended);
    EXPECT_TRUE(again.holds);
    EXPECT_EQ(again.orders.at(0).order, 5);
    EXPECT_EQ(again.orders.at(1).order, 4);
  }
}

TEST(DoorSchemes, SayToHowManyDigits) {
  const SchemeAudit right = audited(core::yoshida_6);
  EXPECT_TRUE(right.holds);
  EXPECT_EQ(right.digits, 15);
  EXPECT_GT(right.orders.at(0).digits, 12);
  EXPECT_LT(right.orders.at(0).next_digits, 3);
  core::expect_words(to_text(right),
                     {"family composition", "order 6; its conditions are met to", "symmetric", "holds"});
  EXPECT_EQ(to_line(right), right.file + ": holds: order 6");
}

TEST(DoorSchemes, HoldClaimsOfTheRequest) {
  EXPECT_TRUE(audited(core::fehlberg, {.file = {}, .order = 5, .embedded_order = 4}).holds);
  const SchemeAudit low = audited(core::fehlberg, {.file = {}, .order = 6});
  EXPECT_FALSE(low.holds);
  EXPECT_TRUE(low.repair.empty());
  core::expect_words(to_text(low), {"order 5 and not 6 as claimed", "no change of one or two entries", "fails"});
}

/// Weights that do not add up are no order, with a claim or without.
TEST(DoorSchemes, RefuseOrderZero) {
  EXPECT_FALSE(audited("A = [[0,0],[1,0]]\nb = ['1/2','1/3']\n").holds);
  EXPECT_FALSE(audited("A = [[0,0],['1/2',0]]\nb = [0,1]\nb_hat = ['1/2','1/4']\n").holds);
  EXPECT_TRUE(audited("A = [[0,0],['1/2',0]]\nb = [0,1]\nb_hat = [1,0]\n").holds);
}

TEST(DoorSchemes, FillInWhatIsUnknown) {
  std::string text = core::fehlberg;
  text.replace(text.find("'-3544/2565'"), 12, "'?'");
  const SchemeAudit found = audited(text);
  EXPECT_FALSE(found.holds);
  ASSERT_EQ(found.repair.size(), 1u);
  EXPECT_EQ(found.repair[0].printed, "?");
  EXPECT_EQ(found.repair[0].exact, "-3544/2565");
}

TEST(DoorSchemes, SayWhatIsNotDetermined) {
  const SchemeAudit found = audited(
      "order = 3\nembedded_order = 2\nA = [[0,0,0,0],['1/2',0,0,0],[0,'3/4',0,0],['2/9','1/3',1,0]]\n"
      "b = ['2/9','1/3','4/9',0]\nb_hat = ['7/24','1/4','1/3','1/8']\n");
  EXPECT_FALSE(found.holds);
  EXPECT_TRUE(found.repair.empty() && found.mended.empty());
  core::expect_words(found.repair_says, {"do not determine one"});
}

/// The nodes of Lobatto IIIB with two stages are no row sums. A wrong node is still found.
TEST(DoorSchemes, TakeNodesOfTheirOwn) {
  const std::string lobatto = "A = [['1/2', 0], ['1/2', 0]]\nb = ['1/2', '1/2']\n";
  for (const std::string& claimed : {std::string(), std::string("order = 2\n")}) {
    const SchemeAudit right = audited(claimed + lobatto + "c = [0, 1]\n");
    EXPECT_TRUE(right.holds && right.own_nodes);
    core::expect_words(to_text(right), {"the nodes are not the row sums", "holds"});
    EXPECT_FALSE(audited(claimed + lobatto + "c = [0, '9/10']\n").holds);
  }
  EXPECT_FALSE(audited(lobatto + "c = ['1/2', '1/2']\n").own_nodes);
}

/// Fractions of many digits that are roundings of other numbers, with their digits said or not.
TEST(DoorSchemes, TakeFractionsAsRounded) {
  const std::string gauss =
      "A = [['1/4', '-9914489123/256353060613'], ['276182038859/512706121226', '1/4']]\nb = ['1/2', '1/2']\n";
  const SchemeAudit seen = audited(gauss);
  EXPECT_TRUE(seen.holds && seen.rounded_fractions) << to_text(seen);
  EXPECT_EQ(seen.orders.at(0).order, 4);
  EXPECT_TRUE(audited("digits = 16\norder = 4\n" + gauss).holds);
  // A digit that is off is no rounding.
  std::string wrong = gauss;
  wrong.replace(wrong.find("9914489123"), 5, "99244");
  EXPECT_FALSE(audited("order = 4\n" + wrong).holds);
}

/// Some decimals are printed with fewer digits than others.
TEST(DoorSchemes, TakeEachDecimalWithItsOwnDigits) {
  const std::string rest = "A = [['0.25', '-0.0386751345948128822545'], ['0.5386751345948128822545', '0.25']]\n";
  EXPECT_TRUE(audited("order = 4\nb = ['0.5', '0.5']\n" + rest).holds);
  EXPECT_TRUE(
      audited("order = 4\nc = ['0.2113248654051871177', '0.7886751345948128822545']\nb = ['0.5', '0.5']\n" + rest)
          .holds);
}

TEST(DoorSchemes, EndWhenTheyAreAskedTo) {
  std::stop_source source;
  source.request_stop();
  SchemeRequest request;
  request.stop = source.get_token();
  EXPECT_THROW(audited(with_typo, request), Interrupted);
}

TEST(DoorSchemes, AreTold) {
  const nlohmann::json j = nlohmann::json::parse(to_json(audited(with_typo)));
  EXPECT_EQ(j.at("repair").at(0).at("entry"), "A[6][3]");
  EXPECT_EQ(j.at("repair").at(0).at("exact"), "-3544/2565");
  EXPECT_EQ(j.at("orders").at(0).at("stated"), nullptr);
  EXPECT_EQ(j.at("holds"), false);
  EXPECT_EQ(j.at("consistent"), false);
  EXPECT_THROW(audited(core::fehlberg, {.file = {}, .most_mended = 3}), InputError);
  EXPECT_THROW(audit_scheme({.file = "/nowhere.toml"}), InputError);
  EXPECT_THROW(audited("digits = 0\n" + core::fehlberg), InputError);
}

}  // namespace
}  // namespace hbvm

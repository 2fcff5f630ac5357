#include <gtest/gtest.h>

#include <algorithm>

#include "audit/claims.hpp"
#include "folder.hpp"
#include "scalar/literal.hpp"
#include "step/hbvm_method.hpp"
#include "step/tableau_method.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

/// Every key, a scene and a tableau beside the file, and a claim of round-off.
const std::string good_claims = R"([[claim]]
label = "claim 7"
quantity = "raw_p"
problem = "double_pendulum"
method = "hbvm:3,2"
rate = "2*s+k-1"
form = "exactly"
over = "step"
perturb = { part = "integral", i = 3, j = 2, hat = true, relative = "1e-25" }

[[claim]]
quantity = "H"
problem = "own.toml"
method = "midpoint.toml"
rate = "2*s"

[[claim]]
quantity = "angular momentum"
problem = "kepler"
method = "hbvm:2,2"
rate = "round-off"
)";

const std::string own_scene = R"(dimension = 2
body = [{ name = "a", mass = 1, position = [1, 0], velocity = [0, 1] }]
)";
const std::string midpoint = R"(name = "midpoint"
A = [["1/2"]]
b = [1]
)";

class ReadClaims : public ::testing::Test {
 protected:
  ReadClaims() {
    folder_.write("own.toml", own_scene);
    folder_.write("midpoint.toml", midpoint);
  }

  std::string path() const { return folder_ / "claims.toml"; }
  std::vector<Claim> read(const std::string& text) const { return read_claims(folder_.write("claims.toml", text)); }
  static std::string changed(const std::string& from, const std::string& to) {
    std::string text = good_claims;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  }
  void expect_refusal(const std::string& text, int line, const std::vector<std::string>& words) const {
    const std::string message = message_of([&] { read(text); });
    EXPECT_TRUE(message.starts_with(path() + ":" + std::to_string(line) + ": ")) << line << " is not in " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_EQ(message.rfind(path()), 0u) << "the place stands twice in " << message;
    for (const std::string& word : words) EXPECT_NE(message.find(word), std::string::npos) << word << ": " << message;
  }

  Folder folder_;
};

TEST_F(ReadClaims, TakesAllKeys) {
  const auto claims = read(good_claims);
  ASSERT_EQ(claims.size(), 3u);
  const Claim& c = claims[0];
  EXPECT_EQ(c.label, "claim 7");
  EXPECT_EQ(c.quantity, Quantity::p);
  EXPECT_EQ(c.problem, "double_pendulum");
  const HbvmMethod* const method = as_hbvm(*c.method);
  ASSERT_TRUE(method);
  EXPECT_EQ(method->name(), (HbvmName{3, 2}));
  EXPECT_EQ(c.predicted, 6);
  EXPECT_EQ(c.form, Form::exactly);
  EXPECT_EQ(c.span, Span::step);
  const std::optional<Perturbation>& p = method->perturbation();
  ASSERT_TRUE(p);
  EXPECT_EQ(p->part, Perturbation::Part::integral);
  EXPECT_TRUE(p->hat);
  EXPECT_EQ(p->i, 2);
  EXPECT_EQ(p->j, 1);
  EXPECT_EQ(p->relative.text(), "1e-25");
}

TEST_F(ReadClaims, MayLeaveOutKeys) {
  const Claim c = read(good_claims)[1];
  EXPECT_EQ(c.label, "stated");
  EXPECT_EQ(c.form, Form::at_least);
  EXPECT_EQ(c.span, Span::interval);
  EXPECT_FALSE(as_hbvm(*c.method));
}

TEST_F(ReadClaims, FilesStandBesideTheClaims) {
  const Claim c = read(good_claims)[1];
  EXPECT_EQ(c.problem, folder_ / "own.toml");
  ASSERT_TRUE(as_tableau(*c.method));
  EXPECT_EQ(c.method_text(), "midpoint");
  EXPECT_EQ(c.predicted, 2) << "s is the number of stages";
}

TEST_F(ReadClaims, FilesMayStandElsewhere) {
  const std::string elsewhere = folder_ / "midpoint.toml";
  EXPECT_TRUE(as_tableau(*read(changed("midpoint.toml", elsewhere))[1].method));
}

TEST_F(ReadClaims, RoundOffIsAForm) {
  const Claim c = read(good_claims)[2];
  EXPECT_EQ(c.form, Form::round_off);
  EXPECT_EQ(c.quantity, Quantity::angular_momentum);
}

TEST_F(ReadClaims, RatesMayBeNumbers) {
  EXPECT_EQ(read(changed("\"2*s+k-1\"", "3"))[0].predicted, 3);
  EXPECT_EQ(read(changed("\"2*s+k-1\"", "2.5"))[0].predicted, double{5} / 2);
  EXPECT_EQ(read(changed("\"2*s+k-1\"", "0"))[0].predicted, 0);
}

TEST_F(ReadClaims, MaySpeakOfDegenerateMotions) {
  EXPECT_FALSE(read(good_claims)[0].of_degenerate_motion);
  EXPECT_TRUE(read(changed("over = \"step\"", "over = \"step\"\ndegenerate = true"))[0].of_degenerate_motion);
  expect_refusal(changed("over = \"step\"", "over = \"step\"\ndegenerate = 1"), 9, {"'degenerate' is true or false"});
}

TEST_F(ReadClaims, PerturbationsCountFromOneAndAreNotOfTheHats) {
  using Part = Perturbation::Part;
  for (const auto& [name, part] :
       {std::pair("node", Part::node), {"weight", Part::weight}, {"X", Part::X}, {"legendre", Part::legendre}}) {
    const auto claims =
        read(changed("part = \"integral\", i = 3, j = 2, hat = true", "part = \"" + std::string(name) + "\""));
    const Perturbation& p = *as_hbvm(*claims[0].method)->perturbation();
    EXPECT_EQ(p.part, part) << name;
    EXPECT_FALSE(p.hat);
    EXPECT_EQ(p.i, 0);
    EXPECT_EQ(p.j, 0);
  }
}

TEST_F(ReadClaims, RefusesMissingKeys) {
  expect_refusal(changed("quantity = \"raw_p\"\n", ""), 1, {"claim 1", "'quantity' is missing"});
  expect_refusal(changed("problem = \"double_pendulum\"\n", ""), 1, {"claim 1", "'problem' is missing"});
  expect_refusal(changed("method = \"midpoint.toml\"\n", ""), 11, {"claim 2", "'method' is missing"});
  expect_refusal(changed("rate = \"round-off\"\n", ""), 17, {"claim 3", "'rate' is missing"});
  expect_refusal(changed("part = \"integral\", ", ""), 9, {"perturb", "'part' is missing"});
  expect_refusal(changed(", relative = \"1e-25\"", ""), 9, {"perturb", "'relative' is missing"});
}

TEST_F(ReadClaims, RefusesUnknownKeys) {
  expect_refusal(changed("over = ", "ovre = "), 8, {"claim 1", "unknown key 'ovre'", "'over'"});
  expect_refusal(changed("hat = true", "hatt = true"), 9, {"perturb", "unknown key 'hatt'", "'hat'"});
  expect_refusal("title = \"x\"\n" + good_claims, 1, {"unknown key 'title'"});
  expect_refusal(good_claims + "[more]\nx = 1\n", 22, {"unknown key 'more'"});
}

TEST_F(ReadClaims, RefusesUnknownNames) {
  expect_refusal(changed("\"H\"", "\"energy\""), 11, {"claim 2", "unknown quantity 'energy'", "angular momentum"});
  expect_refusal(changed("\"exactly\"", "\"about\""), 1, {"unknown form 'about'", "at least", "exactly"});
  expect_refusal(changed("\"step\"", "\"day\""), 1, {"'over'", "day", "interval", "step"});
  expect_refusal(changed("\"integral\"", "\"nodes\""), 9, {"unknown part 'nodes'", "legendre"});
}

TEST_F(ReadClaims, RefusesMethods) {
  expect_refusal(changed("hbvm:3,2", "hbvm:auto,2"), 1, {"claim 1", "hbvm:auto,2", "states its k"});
  expect_refusal(changed("hbvm:3,2", "hbvm:1,2"), 1, {"claim 1", "hbvm:1,2"});
  expect_refusal(changed("hbvm:3,2", "hbvm:3"), 1, {"claim 1", "hbvm:3"});
  expect_refusal(changed("midpoint.toml", "endpoint.toml"), 11, {"claim 2", "endpoint.toml"});
  folder_.write("broken.toml", "b = [1]\n");
  expect_refusal(changed("midpoint.toml", "broken.toml"), 11, {"claim 2", "broken.toml", "'A' is missing"});
}

TEST_F(ReadClaims, RefusesScenes) {
  expect_refusal(changed("double_pendulum", "square_pendulum"), 1, {"claim 1", "square_pendulum"});
  folder_.write("broken.toml", "dimension = 4\n");
  expect_refusal(changed("own.toml", "broken.toml"), 11, {"claim 2", "broken.toml", "'dimension'"});
}

TEST_F(ReadClaims, RefusesRates) {
  const auto with_rate = [](const std::string& rate) { return changed("\"2*s+k-1\"", rate); };
  expect_refusal(with_rate("\"2*t\""), 6, {"claim 1", "t"});
  expect_refusal(with_rate("\"2*\""), 6, {"claim 1", "'rate'"});
  expect_refusal(with_rate("\"\""), 6, {"claim 1", "'rate'"});
  expect_refusal(with_rate("\"1/0\""), 6, {"claim 1", "1/0"});
  expect_refusal(with_rate("true"), 6, {"claim 1", "'rate'"});
  expect_refusal(with_rate("[2]"), 6, {"claim 1", "'rate'"});
  expect_refusal(with_rate("nan"), 6, {"claim 1", "'rate'"});
  expect_refusal(with_rate("inf"), 6, {"claim 1", "'rate'"});
  expect_refusal(with_rate("-1"), 6, {"claim 1", "no such rate"});
  expect_refusal(with_rate("\"s-3\""), 6, {"claim 1", "no such rate"});
  expect_refusal(with_rate("1000000"), 6, {"claim 1", "no such rate"});
  expect_refusal(with_rate("\"10^400\""), 6, {"claim 1", "10^400"});
}

/// It has stages, but no k: 2*k would be 0, which every error fulfils.
TEST_F(ReadClaims, RefusesKOfATableau) { expect_refusal(changed("\"2*s\"", "\"2*k\""), 15, {"claim 2", "k"}); }

TEST_F(ReadClaims, RefusesRoundOffOfWhatConverges) {
  for (const char* const quantity : {"q", "raw p", "tangential p", "lagmul", "output lambda"})
    expect_refusal(changed("\"angular momentum\"", "\"" + std::string(quantity) + "\""), 17, {"claim 3", "round-off"});
  for (const char* const quantity : {"g", "hidden", "H", "reversal"})
    EXPECT_NO_THROW(read(changed("\"angular momentum\"", "\"" + std::string(quantity) + "\""))) << quantity;
}

TEST_F(ReadClaims, RefusesRatesOfWhatIsRoundOff) {
  for (const char* const quantity : {"g", "reversal"})
    expect_refusal(changed("\"raw_p\"", "\"" + std::string(quantity) + "\""), 1, {"claim 1", quantity, "round-off"});
}

/// Of constraints that are not quadratic g has an order, that of their nodes.
TEST_F(ReadClaims, TakesRatesOfGOfAnyConstraint) {
  const std::string perturbation =
      "perturb = { part = \"integral\", i = 3, j = 2, hat = true, relative = \"1e-25\" }\n";
  const auto of_g = [&](const std::string& problem, const std::string& method) {
    std::string text = good_claims;
    for (const auto& [from, to] : {std::pair<std::string, std::string>("\"raw_p\"", "\"g\""),
                                   {"double_pendulum", problem},
                                   {"hbvm:3,2", method},
                                   {"2*s+k-1", "2*r+1"},
                                   {perturbation, ""}})
      text.replace(text.find(from), from.size(), to);
    return text;
  };
  for (const char* const problem : {"bead_on_torus", "bead_on_quartic", "rod_on_two_curves"}) {
    const Claim c = read(of_g(problem, "hbvm:3,2,5"))[0];
    EXPECT_EQ(c.quantity, Quantity::g);
    EXPECT_EQ(c.form, Form::exactly);
    EXPECT_EQ(c.predicted, 11) << "of 5 nodes";
    EXPECT_EQ(as_hbvm(*c.method)->name(), (HbvmName{3, 2, 5}));
  }
  expect_refusal(of_g("heavy_top", "hbvm:3,2,5"), 1, {"claim 1", "'g'", "round-off", "heavy_top", "quadratic"});
  expect_refusal(of_g("own.toml", "hbvm:3,2,5"), 1, {"claim 1", "'g'", "round-off"});
  expect_refusal(of_g("bead_on_torus", "hbvm:3,2"), 6, {"claim 1", "r"});
  // In a file beside the claims, too.
  folder_.write("own.toml",
                own_scene + "constraint = [{ kind = \"formula\", on = \"a\", g = \"cosh(x) - cosh(1)\" }]\n");
  EXPECT_NO_THROW(read(of_g("own.toml", "hbvm:3,2,5")));
}

TEST_F(ReadClaims, RefusesQuantitiesThatHaveNoRate) {
  for (const char* const quantity : {"hidden constant", "hidden drift", "sweeps"})
    expect_refusal(changed("\"raw_p\"", "\"" + std::string(quantity) + "\""), 1, {"claim 1", quantity, "no rate"});
  expect_refusal(changed("\"raw_p\"", "\"order conditions\""), 1, {"claim 1", "order conditions", "of a tableau"});
  for (const char* const quantity : {"B", "W"})
    expect_refusal(changed("\"raw_p\"", "\"" + std::string(quantity) + "\""), 1, {"claim 1", quantity, "round-off"});
}

/// Coefficients are of no problem, and none need be named.
TEST_F(ReadClaims, OfCoefficientsNeedNoProblem) {
  const std::vector<Claim> claims =
      read("[[claim]]\nquantity = \"order conditions\"\nmethod = \"midpoint.toml\"\nrate = 2\n");
  ASSERT_EQ(claims.size(), 1U);
  EXPECT_EQ(claims[0].quantity, Quantity::order_conditions);
  EXPECT_EQ(claims[0].predicted, 2);
}

TEST_F(ReadClaims, RefusesSpansThatMakeNoSense) {
  expect_refusal(changed("\"H\"", "\"u and v\""), 11, {"claim 2", "u and v", "over = \"step\""});
  for (const char* const quantity : {"delta lambda", "u and v"})
    EXPECT_NO_THROW(read(changed("\"raw_p\"", "\"" + std::string(quantity) + "\""))) << quantity;
  expect_refusal(changed("\"raw_p\"", "\"angular momentum\""), 1, {"claim 1", "angular momentum", "interval"});
}

TEST_F(ReadClaims, RefusesPerturbations) {
  const std::string all = "{ part = \"integral\", i = 3, j = 2, hat = true, relative = \"1e-25\" }";
  expect_refusal(changed(all, "\"node\""), 9, {"claim 1", "'perturb' is a table"});
  expect_refusal(changed(all, "[" + all + "]"), 9, {"claim 1", "'perturb' is a table"});
  expect_refusal(changed("hat = true", "hat = \"yes\""), 9, {"'hat'", "true or false"});
  expect_refusal(changed("hat = true", "hat = 1"), 9, {"'hat'", "true or false"});
  expect_refusal(changed("i = 3", "i = 0"), 9, {"'i'", "between 1 and"});
  expect_refusal(changed("j = 2", "j = -1"), 9, {"'j'", "between 1 and"});
  expect_refusal(changed("i = 3", "i = 9223372036854775807"), 9, {"'i'", "between 1 and"});
  expect_refusal(changed("i = 3", "i = 1.5"), 9, {"'i'", "whole number"});
  expect_refusal(changed("\"1e-25\"", "\"1e-\""), 9, {"'relative'"});
  expect_refusal(changed("\"1e-25\"", "true"), 9, {"'relative'"});
  std::string of_tableau = changed("rate = \"2*s\"\n", "rate = \"2*s\"\nperturb = " + all + "\n");
  expect_refusal(of_tableau, 16, {"claim 2", "tableau"});
}

/// Not only when the audit comes to them.
TEST_F(ReadClaims, RefusesPerturbationsOfNumbersThatAreNotThere) {
  expect_refusal(changed("i = 3", "i = 4"), 9, {"claim 1", "no such number"});
  expect_refusal(changed("j = 2", "j = 3"), 9, {"claim 1", "no such number"});
  expect_refusal(changed("\"integral\", i = 3", "\"X\", i = 2"), 9, {"claim 1", "0"});
  expect_refusal(changed("\"1e-25\"", "\"1/0\""), 9, {"claim 1", "1/0"});
  expect_refusal(changed("\"1e-25\"", "\"eps\""), 9, {"claim 1", "eps"});
}

TEST_F(ReadClaims, RefusesFilesWithoutClaims) {
  expect_refusal("", 1, {"no [[claim]]"});
  expect_refusal("# nothing\n", 1, {"no [[claim]]"});
  expect_refusal("claim = []\n", 1, {"no [[claim]]"});
  expect_refusal("claim = 1\n", 1, {"[[claim]]"});
  expect_refusal("[claim]\nquantity = \"q\"\n", 1, {"[[claim]]"});
}

TEST_F(ReadClaims, RefusesWrongTypes) {
  expect_refusal(changed("\"claim 7\"", "7"), 2, {"'label'", "string"});
  expect_refusal(changed("\"raw_p\"", "[\"q\"]"), 3, {"'quantity'", "string"});
  expect_refusal(changed("\"double_pendulum\"", "2"), 4, {"'problem'", "string"});
  expect_refusal(changed("\"hbvm:3,2\"", "3.2"), 5, {"'method'", "string"});
  expect_refusal(changed("\"exactly\"", "true"), 7, {"'form'", "string"});
  expect_refusal(changed("\"step\"", "1"), 8, {"'over'", "string"});
}

TEST_F(ReadClaims, RefusesWhatIsNoFile) {
  EXPECT_THROW(read_claims(folder_ / "none.toml"), InputError);
  EXPECT_THROW(read_claims(folder_.path().string()), InputError);
  EXPECT_THROW(read_claims(""), InputError);
}

TEST_F(ReadClaims, ReadsOrRefusesEveryBeginning) {
  int read_at_all = 0;
  for (std::size_t length = 0; length <= good_claims.size(); ++length) {
    try {
      EXPECT_FALSE(read(good_claims.substr(0, length)).empty());
      ++read_at_all;
    } catch (const InputError&) {
    }
  }
  EXPECT_GE(read_at_all, 3);
  EXPECT_LT(read_at_all, 100);
}

}  // namespace
}  // namespace hbvm::core

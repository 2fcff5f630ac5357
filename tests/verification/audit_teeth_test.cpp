#include <gtest/gtest.h>

#include <iostream>
#include <random>

#include "audit/audit.hpp"
#include "audit/claim_group.hpp"
#include "folder.hpp"
#include "reference/scene_tables.hpp"
#include "step/hbvm_method.hpp"
#include "step/tableau_method.hpp"

namespace hbvm::core {
namespace {

Claim claim(Quantity quantity, const std::string& problem, HbvmName method, Span span, Form form, double predicted) {
  Claim c = make_claim("test", quantity, problem, span, form, predicted);
  c.method = hbvm_of(method);
  return c;
}

/// One that errors over an interval are round-off.
Claim exact(Quantity quantity, const std::string& problem, HbvmName method) {
  return claim(quantity, problem, method, Span::interval, Form::round_off, 0);
}

std::string text_of(const Finding& f) {
  return std::string(name_of(f.claim.quantity)) + " of " + f.claim.method_text() + " on " + f.claim.problem +
         ": measured " + std::to_string(f.measured) + " +- " + std::to_string(f.uncertainty) + " for " +
         std::to_string(f.claim.predicted) + " in " + f.precision + ", " + f.reason;
}

/// What the errors of one step must show.
std::vector<Claim> order_claims(const std::string& problem, HbvmName method) {
  const int k = method.k, s = method.s;
  std::vector<Claim> claims;
  for (const auto& [quantity, rate] : {std::pair(Quantity::q, 2 * s + 1),
                                       {Quantity::p, s + 1},
                                       {Quantity::tangential_p, 2 * s + 1},
                                       {Quantity::output_lambda, 2 * s + 1},
                                       {Quantity::lagmul, s},
                                       {Quantity::delta_lambda, s},
                                       {Quantity::hidden, s + 1},
                                       {Quantity::polynomials, s + 1},
                                       {Quantity::H, 2 * k + 1}})
    claims.push_back(claim(quantity, problem, method, Span::step, Form::at_least, rate));
  return claims;
}

std::vector<Claim> coefficient_claims(HbvmName method) {
  std::vector<Claim> claims;
  for (const Quantity quantity : {Quantity::B, Quantity::C, Quantity::D, Quantity::X, Quantity::symmetry, Quantity::W})
    claims.push_back(exact(quantity, "tableau", method));
  return claims;
}

int count(const std::vector<Finding>& findings, Verdict verdict) {
  return static_cast<int>(
      std::count_if(findings.begin(), findings.end(), [&](const Finding& f) { return f.verdict == verdict; }));
}

AuditOptions one_start(int jobs = 1) {
  AuditOptions options;
  options.starts = 1;
  options.jobs = jobs;
  return options;
}

Finding found(const Claim& c, const AuditOptions& options = one_start()) { return audit({c}, options).front(); }

/// How many no longer hold. (With some signs flipped steps cannot be made, or rates do not settle.)
int failures(std::vector<Claim> claims, const Perturbation& perturbation) {
  for (Claim& c : claims) c.method = hbvm_of(as_hbvm(*c.method)->name(), perturbation);
  AuditOptions options = one_start();
  options.coefficient_digits = 0;
  return static_cast<int>(claims.size()) - count(audit(claims, options), Verdict::holds);
}

/// One number of the method wrong by a relative 1e-11, 1e-16 or 1e-25, or with its sign flipped, is caught. The errors
/// of one step catch it, with the coefficients never looked at. The coefficients' conditions catch it, too.
class Teeth : public ::testing::TestWithParam<std::tuple<HbvmName, const char*>> {
 protected:
  void expect_caught(Perturbation::Part part, bool hat, int i, int j) {
    const auto& [method, relative] = GetParam();
    const Perturbation perturbation{part, hat, i, j, Expression::parse(relative)};
    SCOPED_TRACE("part " + std::to_string(static_cast<int>(part)) + (hat ? " hat " : " ") + std::to_string(i) + "," +
                 std::to_string(j));
    EXPECT_GE(failures(order_claims("modified_pendulum", method), perturbation), 1);
    EXPECT_GE(failures(coefficient_claims(method), perturbation), 1);
  }
  int s() const { return std::get<HbvmName>(GetParam()).s; }
  int k() const { return std::get<HbvmName>(GetParam()).k; }
};

using Part = Perturbation::Part;

TEST_P(Teeth, CatchAWrongNode) {
  for (const bool hat : {false, true})
    for (const int i : {0, (hat ? k() : s()) - 1}) expect_caught(Part::node, hat, i, 0);
}
TEST_P(Teeth, CatchAWrongWeight) {
  for (const bool hat : {false, true})
    for (const int i : {0, (hat ? k() : s()) - 1}) expect_caught(Part::weight, hat, i, 0);
}
TEST_P(Teeth, CatchAWrongIntegral) {
  for (const bool hat : {false, true}) expect_caught(Part::integral, hat, 0, s() - 1);
}
TEST_P(Teeth, CatchAWrongEntryOfX) {
  expect_caught(Part::X, false, 0, 0);
  if (s() > 1) expect_caught(Part::X, false, s() - 1, s() - 2);
}
TEST_P(Teeth, CatchAWrongLegendreCoefficient) {
  expect_caught(Part::legendre, false, s() - 1, 0);
  expect_caught(Part::legendre, false, s() - 1, s() - 1);
}

INSTANTIATE_TEST_SUITE_P(Audit, Teeth,
                         ::testing::Combine(::testing::Values(HbvmName{1, 1}, HbvmName{3, 2}, HbvmName{4, 4}),
                                            ::testing::Values("1e-11", "1e-16", "1e-25", "-2")),
                         [](const auto& parameter) {
                           const HbvmName method = std::get<HbvmName>(parameter.param);
                           const std::string relative = std::get<const char*>(parameter.param);
                           return "k" + std::to_string(method.k) + "s" + std::to_string(method.s) +
                                  (relative == "-2" ? "sign" : "e" + relative.substr(3));
                         });

/// Nothing is held against the method as it is: five problems, methods, intervals and states at a time.
class NoFalseAlarm : public ::testing::TestWithParam<int> {};

TEST_P(NoFalseAlarm, OnRandomConfigurations) {
  std::mt19937 random(static_cast<unsigned>(GetParam()));
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const char* const problems[] = {"modified_pendulum",   "double_pendulum",  "bead_on_ellipsoid",
                                  "spherical_pendulum",  "four_bar_linkage", "bead_on_paraboloid",
                                  "tethered_satellites", "heavy_top"};
  int undecidable = 0;
  for (int n = 0; n < 5; ++n) {
    const std::string problem = problems[below(8)];
    const bool large = problem == "tethered_satellites" || problem == "heavy_top" || problem == "four_bar_linkage";
    const int s = 1 + below(large ? 2 : 4), k = s + below(3);
    const int r = s % 2 == 0 ? s : s + 1;
    std::vector<Claim> claims = order_claims(problem, {k, s});
    for (const auto& [quantity, rate] : {std::pair(Quantity::q, 2 * s),
                                         {Quantity::p, r},
                                         {Quantity::tangential_p, 2 * s},
                                         {Quantity::output_lambda, 2 * s},
                                         {Quantity::lagmul, r - 1},
                                         {Quantity::hidden, r},
                                         {Quantity::H, 2 * k}})
      claims.push_back(claim(quantity, problem, {k, s}, Span::interval, Form::at_least, rate));
    for (const Quantity quantity : {Quantity::g, Quantity::reversal})
      claims.push_back(exact(quantity, problem, {k, s}));
    AuditOptions options = one_start();
    options.first_start = below(20);
    options.log2_interval = -3 + below(4);
    for (const Finding& f : audit(claims, options)) {
      EXPECT_NE(f.verdict, Verdict::fails)
          << text_of(f) << ", start " << options.first_start << " interval 2^" << options.log2_interval;
      undecidable += f.verdict == Verdict::undecidable;
    }
  }
  EXPECT_EQ(undecidable, 0);
}

INSTANTIATE_TEST_SUITE_P(Audit, NoFalseAlarm, ::testing::Range(0, 3));

/// Statements that are false end in "fails", not in "undecidable".
TEST(Audit, RefusesFalseClaims) {
  std::vector<Claim> claims;
  for (const int s : {1, 2, 3}) {
    const HbvmName method{s, s};
    if (s > 1) claims.push_back(claim(Quantity::p, "modified_pendulum", method, Span::interval, Form::at_least, 2 * s));
    if (s % 2 == 1)  // Theorem 5, on the order, for one step
      claims.push_back(claim(Quantity::p, "modified_pendulum", method, Span::step, Form::at_least, s + 2));
    if (s % 2 == 0)  // Theorem 4, on delta-lambda, for propagated states
      claims.push_back(claim(Quantity::delta_lambda, "modified_pendulum", method, Span::interval, Form::at_least, s));
    claims.push_back(exact(Quantity::H, "modified_pendulum", method));
    claims.push_back(exact(Quantity::angular_momentum, "tethered_satellites", {s + 2, s}));
  }
  // Theorem 4, on delta-lambda, with one order more, and an order claimed "exactly" that is exceeded.
  claims.push_back(claim(Quantity::delta_lambda, "modified_pendulum", {2, 2}, Span::step, Form::at_least, 3));
  claims.push_back(claim(Quantity::q, "modified_pendulum", {2, 2}, Span::interval, Form::exactly, 2));
  for (const Finding& f : audit(claims, one_start())) EXPECT_EQ(f.verdict, Verdict::fails) << text_of(f);
}

/// Over an interval an error of 1e-25 in a node cannot be seen; the error of one step shows it.
TEST(Audit, HoldsAnIntervalAgainstItsSteps) {
  Claim c = claim(Quantity::q, "modified_pendulum", {2, 2}, Span::interval, Form::at_least, 4);
  EXPECT_EQ(found(c).verdict, Verdict::holds);
  c.method = hbvm_of({2, 2}, Perturbation{Part::node, false, 0, 0, Expression::parse("1e-25")});
  AuditOptions options = one_start();
  options.coefficient_digits = 0;
  EXPECT_EQ(found(c, options).verdict, Verdict::fails);
}

/// The evidence falls with the precision: what is round-off in double is an error in more digits.
TEST(Audit, ShowsItsEvidence) {
  const Finding f = found(claim(Quantity::H, "modified_pendulum", {4, 2}, Span::step, Form::at_least, 9));
  ASSERT_EQ(f.verdict, Verdict::holds);
  EXPECT_EQ(f.precision, "mpfr:100");
  EXPECT_NEAR(f.measured, 9, 0.1);
  ASSERT_EQ(f.evidence.size(), 4u);
  EXPECT_EQ(f.evidence.front().precision, "double");
  const auto clean = [](const Ladder& ladder) {
    return std::count_if(ladder.rungs.begin(), ladder.rungs.end(), [](const Rung& r) { return r.is_clean(); });
  };
  for (std::size_t i = 1; i < f.evidence.size(); ++i) EXPECT_GT(clean(f.evidence[i]), clean(f.evidence[i - 1]));
}

/// In double all errors of a high order are round-off: that shows nothing, and more digits must be asked.
TEST(Audit, TakesRoundOffOfDoubleForNoAnswer) {
  Claim c = claim(Quantity::q, "modified_pendulum", {8, 8}, Span::interval, Form::at_least, 16);
  const Finding f = found(c);
  EXPECT_EQ(f.verdict, Verdict::holds);
  EXPECT_NEAR(f.measured, 16, 0.5);
  EXPECT_GE(f.evidence.size(), 3u);
  c.predicted = 18;
  EXPECT_EQ(found(c).verdict, Verdict::fails);
}

/// A rung that is lost in the error of the reference is no proof that the error is small.
TEST(Audit, TakesTheReferencesErrorForNoAnswer) {
  const Rung lost{-3, -20, -18, true};
  EXPECT_FALSE(lost.is_clean());
  ClaimGroup group;
  group.claims.push_back(claim(Quantity::q, "kepler", {1, 1}, Span::interval, Form::at_least, 2));
  EXPECT_FALSE(group.is_lost({{Quantity::q, {lost}}}));
  EXPECT_TRUE(group.is_lost({{Quantity::q, {{-3, -20, -18}}}}));
}

TEST(Audit, KnowsWhatDoesNotExist) {
  const Finding f = found(claim(Quantity::hidden, "kepler", {2, 2}, Span::step, Form::at_least, 3));
  EXPECT_EQ(f.verdict, Verdict::undecidable);
  EXPECT_NE(f.reason.find("does not exist"), std::string::npos);
}

TEST(Audit, GivesTheSameOnSeveralThreads) {
  std::vector<Claim> claims;
  for (const char* const problem : {"modified_pendulum", "double_pendulum", "kepler"})
    claims.push_back(claim(Quantity::q, problem, {2, 2}, Span::step, Form::at_least, 5));
  AuditOptions options = one_start();
  const std::vector<Finding> alone = audit(claims, options);
  options.jobs = 3;
  const std::vector<Finding> together = audit(claims, options);
  for (std::size_t i = 0; i < claims.size(); ++i) {
    EXPECT_EQ(alone[i].measured, together[i].measured);
    EXPECT_EQ(alone[i].evidence.back().rungs.back().error, together[i].evidence.back().rungs.back().error);
  }
}

/// A weight or node of the constraints' quadrature off by 1e-25 is seen where the nodes keep g.
TEST(Teeth, OfTheConstraintQuadrature) {
  const HbvmName method{2, 2, 4};
  const std::vector<Claim> claims{exact(Quantity::g, "bead_on_quartic", method),
                                  exact(Quantity::H, "bead_on_torus", method)};
  AuditOptions options = one_start();
  EXPECT_EQ(count(audit(claims, options), Verdict::holds), 2);
  for (const Part part : {Part::weight, Part::node, Part::integral})
    EXPECT_GE(failures({claims[0]}, {part, false, 1, 0, Expression::parse("1e-25")}), 1) << static_cast<int>(part);
}

/// The Gauss method of two stages with one entry of A or b off.
std::string gauss(const std::string& off_in_A, const std::string& off_in_b) {
  return "name = \"Gauss\"\nA = [[\"1/4\", \"1/4-sqrt(3)/6" + off_in_A +
         "\"], [\"1/4+sqrt(3)/6\", \"1/4\"]]\nb = [\"1/2" + off_in_b +
         "\", \"1/2\"]\nc = [\"1/2-sqrt(3)/6\", \"1/2+sqrt(3)/6\"]\n";
}

/// A quartic oscillator beside which something that is no polynomial is this strong.
std::string disturbed(const std::string& strength) {
  return "dimension = 2\n" + point("o", "[0, 0]") + body("a", "1", "[1, \"1/3\"]", "[\"-1/5\", \"2/3\"]") +
         effect("trap", "center = \"o\"\nstiffness = 1\nexponent = 4") +
         effect("central_gravity", "center = \"o\"\nstrength = \"" + strength + "\"");
}

TEST(AuditClaims, FalseOnesNeverHold) {
  const Folder files;
  std::vector<Claim> claims;
  // Rates that are not whole, above the true one by so much, or claimed exactly and below it.
  for (const double off : {0.05, 0.1, 0.25, 0.4, 0.49})
    for (const auto& [problem, method, quantity, rate] :
         {std::tuple("modified_pendulum", HbvmName{1, 1}, Quantity::q, 2),
          {"kepler", HbvmName{2, 2}, Quantity::q, 4},
          {"double_pendulum", HbvmName{3, 2}, Quantity::tangential_p, 4}})
      for (const auto& [span, order] : {std::pair(Span::interval, rate), {Span::step, rate + 1}}) {
        claims.push_back(claim(quantity, problem, method, span, Form::at_least, order + off));
        if (span == Span::step && off < 0.3)
          claims.push_back(claim(quantity, problem, method, span, Form::exactly, order - off));
      }
  // Errors that only more digits or longer steps show.
  claims.push_back(exact(Quantity::H, "modified_pendulum", {30, 1}));
  claims.push_back(exact(Quantity::H, "modified_pendulum", {60, 1}));
  claims.push_back(exact(Quantity::H, "kepler", {20, 2}));
  claims.push_back(exact(Quantity::angular_momentum, "kepler", {45, 40}));
  claims.push_back(exact(Quantity::angular_momentum, "kepler", {14, 12}));
  for (const char* const strength : {"10^(-40)", "10^(-80)", "10^(-150)"})
    claims.push_back(
        exact(Quantity::H, files.write("disturbed" + std::string(strength) + ".toml", disturbed(strength)), {4, 2}));
  // Coefficients.
  const HbvmName any{1, 1};
  for (const char* const digits : {"30", "60", "95", "300"}) {
    const std::string off = std::string("+10^(-") + digits + ")";
    const MethodPtr in_A = tableau_method(files.write(std::string("A") + digits + ".toml", gauss(off, ""))),
                    in_b = tableau_method(files.write(std::string("b") + digits + ".toml", gauss("", off)));
    for (Claim c : {claim(Quantity::q, "kepler", any, Span::interval, Form::at_least, 4),
                    claim(Quantity::order_conditions, "tableau", any, Span::interval, Form::at_least, 4),
                    exact(Quantity::angular_momentum, "kepler", any)}) {
      c.method = in_b;
      claims.push_back(c);
      if (c.quantity == Quantity::angular_momentum) continue;
      c.method = in_A;
      claims.push_back(c);
    }
  }
  EXPECT_GE(claims.size(), 60u);
  for (const Finding& f : audit(claims, one_start(2))) EXPECT_EQ(f.verdict, Verdict::fails) << text_of(f);
}

/// Scenes of uneven units, lengths and masses, all exact.
class UnevenScene {
 public:
  explicit UnevenScene(unsigned seed) : random_(seed) {}

  std::string text() {
    constrained_ = below(3) > 0;
    const int bodies = 1 + below(2);
    std::string text = "dimension = 2\n[constants]\nL = \"" + power(-12, 12) + "\"\nT = \"" + power(-9, 9) +
                       "\"\nM = \"" + power(-20, 20) + "\"\nG = \"L/T^2\"\n" + point("o", "[0, 0]");
    std::string x = "0", y = "0", vx = "0", vy = "0", rods;
    for (int i = 0; i < bodies; ++i) {
      const auto [a, b] = direction();
      const std::string length = fraction() + "*L", turn = fraction() + "*L/T", name = "b" + std::to_string(i);
      x += "+" + a + "*" + length;
      y += "+" + b + "*" + length;
      vx += "-" + b + "*" + turn;
      vy += "+" + a + "*" + turn;
      text += body(name, "\"M" + (i > 0 ? "*" + power(-4, 2) : "") + "\"", "[\"" + x + "\", \"" + y + "\"]",
                   "[\"" + vx + "\", \"" + vy + "\"]");
      rods += rod(i > 0 ? "b" + std::to_string(i - 1) : "o", name, "\"" + length + "\"");
    }
    if (constrained_) text += rods;
    text += effect("central_gravity", "center = \"o2\"\nstrength = \"" + fraction() + "*4*L^2*G\"");
    text += point("o2", "[\"L/7\", \"-3*L\"]");
    if (constrained_) text += field("[0, \"-G\"]");
    return text;
  }
  HbvmName method() {
    const int s = 1 + below(3);
    return {s + below(3), s};
  }
  bool is_constrained() const { return constrained_; }

 private:
  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  std::string power(int least, int most) { return "10^(" + std::to_string(least + below(most - least + 1)) + ")"; }
  std::string fraction() { return std::to_string(2 + below(3)) + "/" + std::to_string(3 + below(3)); }
  std::pair<std::string, std::string> direction() {
    const std::pair<const char*, const char*> all[] = {
        {"3/5", "4/5"}, {"5/13", "-12/13"}, {"-8/17", "15/17"}, {"-7/25", "-24/25"}, {"20/29", "21/29"}};
    const auto [a, b] = all[below(5)];
    return {std::string("(") + a + ")", std::string("(") + b + ")"};
  }

  std::mt19937 random_;
  bool constrained_ = false;
};

TEST(AuditClaims, TrueOnesNeverFail) {
  const Folder files;
  std::vector<Claim> claims;
  for (unsigned seed = 1; claims.size() < 200; ++seed) {
    UnevenScene scene(seed);
    const std::string problem = files.write("scene" + std::to_string(seed) + ".toml", scene.text());
    const HbvmName method = scene.method();
    const int k = method.k, s = method.s, r = s % 2 == 0 ? s : s + 1;
    const auto add = [&](Quantity quantity, Span span, double rate) {
      claims.push_back(claim(quantity, problem, method, span, Form::at_least, rate));
    };
    add(Quantity::q, Span::interval, 2 * s);
    add(Quantity::q, Span::step, 2 * s + 1 - 0.05);
    add(Quantity::p, Span::step, scene.is_constrained() ? s + 1 : 2 * s + 1);
    add(Quantity::p, Span::interval, scene.is_constrained() ? r : 2 * s);
    add(Quantity::H, Span::interval, 2 * k);
    add(Quantity::H, Span::step, 2 * k + 0.5);
    claims.push_back(exact(Quantity::reversal, problem, method));
    if (!scene.is_constrained()) continue;
    add(Quantity::tangential_p, Span::interval, 2 * s);
    add(Quantity::output_lambda, Span::step, 2 * s + 1);
    add(Quantity::hidden, Span::step, s + 1);
    add(Quantity::lagmul, Span::step, s);
    claims.push_back(exact(Quantity::g, problem, method));
  }
  int undecided = 0;
  for (const Finding& f : audit(claims, one_start(2))) {
    EXPECT_NE(f.verdict, Verdict::fails) << text_of(f);
    undecided += f.verdict != Verdict::holds;
    if (f.verdict != Verdict::holds) std::cout << name_of(f.verdict) << ": " << text_of(f) << "\n";
  }
  EXPECT_LE(20 * undecided, static_cast<int>(claims.size()));
}

}  // namespace
}  // namespace hbvm::core

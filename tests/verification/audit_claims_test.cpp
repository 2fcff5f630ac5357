#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "audit/audit.hpp"
#include "step/hbvm_method.hpp"
#include "step/tableau_method.hpp"

namespace hbvm::core {
namespace {

namespace fs = std::filesystem;

/// Files that are gone after the test.
class AuditClaims : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* const test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / (std::string("hbvm_audit_claims_") + test->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }

  static Claim claim(Quantity quantity, const std::string& problem, HbvmName method, Span span, Form form,
                     double predicted) {
    Claim c = make_claim("test", quantity, problem, span, form, predicted);
    c.method = hbvm_of(method);
    return c;
  }
  static Claim exact(Quantity quantity, const std::string& problem, HbvmName method) {
    return claim(quantity, problem, method, Span::interval, Form::round_off, 0);
  }

  static std::vector<Finding> audited(const std::vector<Claim>& claims) {
    AuditOptions options;
    options.starts = 1;
    options.jobs = 2;
    return audit(claims, options);
  }
  static std::string text_of(const Finding& f) {
    return std::string(name_of(f.claim.quantity)) + " of " + f.claim.method_text() + " on " + f.claim.problem +
           ": measured " + std::to_string(f.measured) + " +- " + std::to_string(f.uncertainty) + " for " +
           std::to_string(f.claim.predicted) + " in " + f.precision + ", " + f.reason;
  }

 private:
  fs::path folder_;
};

/// The Gauss method of two stages with one entry of A or b off.
std::string gauss(const std::string& off_in_A, const std::string& off_in_b) {
  return "name = \"Gauss\"\nA = [[\"1/4\", \"1/4-sqrt(3)/6" + off_in_A +
         "\"], [\"1/4+sqrt(3)/6\", \"1/4\"]]\nb = [\"1/2" + off_in_b +
         "\", \"1/2\"]\nc = [\"1/2-sqrt(3)/6\", \"1/2+sqrt(3)/6\"]\n";
}

/// A quartic oscillator beside which something that is no polynomial is this strong.
std::string disturbed(const std::string& strength) {
  return "dimension = 2\n[[point]]\nname = \"o\"\nposition = [0, 0]\n[[body]]\nname = \"a\"\nmass = 1\n"
         "position = [1, \"1/3\"]\nvelocity = [\"-1/5\", \"2/3\"]\n[[effect]]\nkind = \"trap\"\ncenter = \"o\"\n"
         "stiffness = 1\nexponent = 4\n"
         "[[effect]]\nkind = \"central_gravity\"\ncenter = \"o\"\nstrength = \"" +
         strength + "\"\n";
}

TEST_F(AuditClaims, FalseOnesNeverHold) {
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
        exact(Quantity::H, write("disturbed" + std::string(strength) + ".toml", disturbed(strength)), {4, 2}));
  // Coefficients.
  const HbvmName any{1, 1};
  for (const char* const digits : {"30", "60", "95", "300"}) {
    const std::string off = std::string("+10^(-") + digits + ")";
    const MethodPtr in_A = tableau_method(write(std::string("A") + digits + ".toml", gauss(off, ""))),
                    in_b = tableau_method(write(std::string("b") + digits + ".toml", gauss("", off)));
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
  for (const Finding& f : audited(claims)) EXPECT_EQ(f.verdict, Verdict::fails) << text_of(f);
}

/// Scenes of uneven units, lengths and masses, all exact.
class UnevenScene {
 public:
  explicit UnevenScene(unsigned seed) : random_(seed) {}

  std::string text() {
    constrained_ = below(3) > 0;
    const int bodies = 1 + below(2);
    std::string text = "dimension = 2\n[constants]\nL = \"" + power(-12, 12) + "\"\nT = \"" + power(-9, 9) +
                       "\"\nM = \"" + power(-20, 20) +
                       "\"\nG = \"L/T^2\"\n[[point]]\nname = \"o\"\nposition = [0, 0]\n";
    std::string x = "0", y = "0", vx = "0", vy = "0", rods, effects;
    for (int i = 0; i < bodies; ++i) {
      const auto [a, b] = direction();
      const std::string length = fraction() + "*L", turn = fraction() + "*L/T", name = "b" + std::to_string(i);
      x += "+" + a + "*" + length;
      y += "+" + b + "*" + length;
      vx += "-" + b + "*" + turn;
      vy += "+" + a + "*" + turn;
      text += "[[body]]\nname = \"" + name + "\"\nmass = \"M" + (i > 0 ? "*" + power(-4, 2) : "") +
              "\"\nposition = [\"" + x + "\", \"" + y + "\"]\nvelocity = [\"" + vx + "\", \"" + vy + "\"]\n";
      rods += "[[constraint]]\nkind = \"rod\"\nbetween = [\"" + (i > 0 ? "b" + std::to_string(i - 1) : "o") + "\", \"" +
              name + "\"]\nlength = \"" + length + "\"\n";
    }
    if (constrained_) text += rods;
    text += "[[effect]]\nkind = \"central_gravity\"\ncenter = \"o2\"\nstrength = \"" + fraction() + "*4*L^2*G\"\n";
    text += "[[point]]\nname = \"o2\"\nposition = [\"L/7\", \"-3*L\"]\n";
    if (constrained_) text += "[[effect]]\nkind = \"uniform_gravity\"\nacceleration = [0, \"-G\"]\n";
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

TEST_F(AuditClaims, TrueOnesNeverFail) {
  std::vector<Claim> claims;
  for (unsigned seed = 1; claims.size() < 200; ++seed) {
    UnevenScene scene(seed);
    const std::string problem = write("scene" + std::to_string(seed) + ".toml", scene.text());
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
  for (const Finding& f : audited(claims)) {
    EXPECT_NE(f.verdict, Verdict::fails) << text_of(f);
    undecided += f.verdict != Verdict::holds;
    if (f.verdict != Verdict::holds) std::cout << name_of(f.verdict) << ": " << text_of(f) << "\n";
  }
  EXPECT_LE(20 * undecided, static_cast<int>(claims.size()));
}

}  // namespace
}  // namespace hbvm::core

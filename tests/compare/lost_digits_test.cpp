#include "compare/lost_digits.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <set>
#include <stop_token>

#include "compare/comparison.hpp"
#include "hbvm/error.hpp"
#include "interruption.hpp"
#include "linear/product.hpp"
#include "printing.hpp"
#include "reference/taylor.hpp"
#include "scalar/literal.hpp"
#include "scalar/text.hpp"
#include "scene/assemble.hpp"
#include "scene/scene.hpp"

namespace hbvm::core {
namespace {

using Change = std::function<void(Vector<Mpfr>& q, Vector<Mpfr>& p)>;

class LostDigits : public InDigits<60> {
 protected:
  /// The motion of a scene at four times, with each state changed, or with another start, as a file.
  static FileComparison judged(const std::string& scene_name, const Change& change, const Change& of_start = {},
                               const std::string& delay = "0", int apart = 1) {
    ComparisonRequest request;
    request.scene = load_scene(scene_name);
    const Assembled<Mpfr> scene = assemble<Mpfr>(request.scene);
    Vector<Mpfr> q = scene.q0, p = scene.p0;
    if (of_start) of_start(q, p);
    TaylorMotion motion(scene.problem, q, p);
    std::string csv = "t";
    const Index m = scene.problem.mass.of_bodies();
    for (const char x : {'q', 'p'})
      for (Index j = 1; j <= m; ++j) csv += fmt::format(",{}_{}", x, j);
    for (int t = apart; t <= 4 * apart; t += apart) {
      motion.advance_to(Mpfr(t) + literal<Mpfr>(delay));
      q = motion.q();
      p = motion.p();
      if (change) change(q, p);
      csv += fmt::format("\n{}", t);
      for (const Vector<Mpfr>* const x : {&q, &p})
        for (Index j = 0; j < m; ++j) csv += "," + to_scientific((*x)[j], 40);
    }
    request.files.push_back({"theirs.csv", csv + "\n"});
    return compare_with_reference(request).files.front();
  }
};

/// One part of the error at a time: along the rod, along its rate, of the speed, of the time, and of the start.
TEST_F(LostDigits, SaysWhatAnErrorIs) {
  const Mpfr small = literal<Mpfr>("1e-9");
  const FileComparison longer = judged("simple_pendulum", [&](auto& q, auto&) { q *= 1 + small; });
  EXPECT_EQ(longer.mostly, LostBy::g);
  EXPECT_NEAR(-longer.g_drift.back(), 9, 0.5);

  const FileComparison across = judged("simple_pendulum", [&](auto& q, auto& p) { p += small * q; });
  EXPECT_EQ(across.mostly, LostBy::hidden);
  EXPECT_NEAR(-across.hidden_drift.back(), 9, 1);
  EXPECT_GT(-across.g_drift.back(), 35);

  const FileComparison faster = judged("simple_pendulum", [&](auto&, auto& p) { p *= 1 + small; });
  EXPECT_EQ(faster.mostly, LostBy::energy);
  EXPECT_NEAR(-faster.H_drift.back(), 9, 1);
  EXPECT_GT(-faster.hidden_drift.back(), 35);

  const FileComparison late = judged("simple_pendulum", {}, {}, "1e-9");
  EXPECT_GT(-late.H_drift.back(), 35);
  EXPECT_EQ(late.by_growth.size(), 4U);
}

/// The error of a start is magnified by a double pendulum, and by nothing else.
TEST_F(LostDigits, KnowsTheGrowthOfTheMotion) {
  const FileComparison file = judged(
      "double_pendulum", {},
      [](auto& q, auto& p) {
        // Both rods turned by a little keep to the constraints, and lose their energy by another.
        const Mpfr small = literal<Mpfr>("1e-12");
        for (Vector<Mpfr>* const x : {&q, &p})
          for (Index i = 0; i < 4; i += 2) {
            const Mpfr first = (*x)[i];
            (*x)[i] -= small * (*x)[i + 1];
            (*x)[i + 1] += small * first;
          }
      },
      "0", 5);
  EXPECT_LT(file.by_growth.back(), file.by_growth.front() - 2);
  EXPECT_NEAR(file.by_growth.back(), -file.error, 1e-3);
  EXPECT_EQ(file.mostly, LostBy::growth);
}

/// Damping and drive change H, and what is off is told beside that of the exact state.
TEST_F(LostDigits, ComparesHWithThatOfTheExactState) {
  const FileComparison exact = judged("driven_pendulum", {});
  EXPECT_GT(-exact.H_drift.back(), 35);
  EXPECT_GT(-exact.hidden_drift.back(), 35);
  const FileComparison faster = judged("driven_pendulum", [](auto&, auto& p) { p *= 1 + literal<Mpfr>("1e-6"); });
  EXPECT_NEAR(-faster.H_drift.back(), 6, 2);
}

/// A state from which there is no motion has no tangent space, and is judged all the same.
TEST_F(LostDigits, JudgesAnyState) {
  const FileComparison zero = judged("simple_pendulum", [](auto& q, auto&) { q *= 0; });
  EXPECT_TRUE(std::isnan(zero.hidden_drift.back()));
  EXPECT_EQ(zero.mostly, LostBy::g);
  EXPECT_EQ(zero.by_growth.size(), 4U);
}

/// Whoever asks for an end gets it while the growth is looked for.
TEST_F(LostDigits, AnswersThatTheWorkIsToEnd) {
  std::stop_source asked;
  asked.request_stop();
  const StopRequest request{asked.get_token(), nullptr};
  const StopScope scope(&request);
  const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene("simple_pendulum"));
  EXPECT_THROW(growth_of_changes(scene.problem, scene.q0, scene.p0, literal<Mpfr>("1e-9"), {Mpfr(1)}), Interrupted);
}

/// Where no state near by fulfils the constraints it is said, and no motion is followed from it.
TEST_F(LostDigits, RefusesToMoveAStateFromFarAway) {
  const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene("simple_pendulum"));
  Vector<Mpfr> q = Vector<Mpfr>::Zero(2), p = scene.p0;
  EXPECT_THROW(DriftGauge(scene.problem).make_consistent(q, p), IntegrationError);
  q = scene.q0 * literal<Mpfr>("1.001");
  DriftGauge(scene.problem).make_consistent(q, p);
  EXPECT_LE(distance<Mpfr>(q, scene.q0), 100 * epsilon<Mpfr>());
}

/// Every part has words of its own.
TEST_F(LostDigits, HasAName) {
  std::set<std::string> names;
  for (const LostBy part : {LostBy::growth, LostBy::g, LostBy::hidden, LostBy::energy, LostBy::motion})
    names.insert(name_of(part));
  EXPECT_EQ(names.size(), 5U);
}

}  // namespace
}  // namespace hbvm::core

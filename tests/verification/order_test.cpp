#include <map>

#include "integrate/drift.hpp"
#include "integrate/output_state.hpp"
#include "integrate/runs.hpp"
#include "printing.hpp"
#include "verification/models.hpp"

namespace hbvm::core {
namespace {

double rate(const Mpfr& coarse, const Mpfr& fine) {
  return approximately(Mpfr(log(Mpfr(coarse / fine)) / log(Mpfr(2))));
}

/// The energy error where the potential is no polynomial and the Gram matrix varies: order 2k, whatever s.
class EnergyOrder : public ::testing::TestWithParam<std::tuple<const char*, int, int>> {
 protected:
  PrecisionScope digits{50};
};

TEST_P(EnergyOrder, IsTwiceK) {
  const auto [name, k, s] = GetParam();
  const Scene scene = load_scene(scene_path(name));
  std::vector<Mpfr> errors;
  for (const char* step : {"1/32", "1/64", "1/128"}) {
    SceneRun<Mpfr> run(scene, k, s, step, "1");
    Drift<Mpfr> drift(run.scene.problem);
    run({&drift});
    EXPECT_LE(drift.e_g(), 1'000 * epsilon<Mpfr>());
    errors.push_back(drift.e_H());
  }
  EXPECT_GT(errors.back(), literal<Mpfr>("1e-45")) << "at round-off";
  for (std::size_t i = 1; i < errors.size(); ++i) EXPECT_NEAR(rate(errors[i - 1], errors[i]), 2 * k, 0.2);
}

std::string name_of_case(const ::testing::TestParamInfo<std::tuple<const char*, int, int>>& info) {
  const auto& [name, k, s] = info.param;
  return std::string(name) + "_" + std::to_string(k) + "_" + std::to_string(s);
}

INSTANTIATE_TEST_SUITE_P(Methods, EnergyOrder,
                         ::testing::Values(std::tuple("ellipsoid_bead", 1, 1), std::tuple("ellipsoid_bead", 2, 1),
                                           std::tuple("ellipsoid_bead", 3, 1), std::tuple("ellipsoid_bead", 2, 2),
                                           std::tuple("ellipsoid_bead", 3, 2), std::tuple("ellipsoid_bead", 3, 3),
                                           std::tuple("spherical_pendulum", 1, 1),
                                           std::tuple("spherical_pendulum", 2, 1),
                                           std::tuple("spherical_pendulum", 2, 2),
                                           std::tuple("spherical_pendulum", 3, 2)),
                         name_of_case);

/// The conserved energy of a linear potential, whatever k >= s.
TEST(Energy, OfTheDoublePendulumIsKeptToRoundOff) {
  const PrecisionScope digits(50);
  for (const auto& [k, s] : std::vector<std::pair<int, int>>{{1, 1}, {3, 1}, {2, 2}, {5, 3}}) {
    SceneRun<Mpfr> run(load_scene(scene_path("double_pendulum")), k, s, "1/8", "4");
    Drift<Mpfr> drift(run.scene.problem);
    run({&drift});
    EXPECT_LE(drift.e_H(), 1'000 * epsilon<Mpfr>()) << k << "," << s;
    EXPECT_LE(drift.e_g(), 1'000 * epsilon<Mpfr>()) << k << "," << s;
    EXPECT_GT(drift.e_hid(), literal<Mpfr>("1e-10")) << k << "," << s;
  }
}

/// Orders of the double pendulum, a nonlinear witness of unequal masses and varying Gram matrix. Errors are maxima over
/// the mesh points of the coarsest grid, even numbers of steps.
class DoublePendulumOrder : public ::testing::TestWithParam<int> {
 protected:
  struct Errors {
    Mpfr q = 0, raw_p = 0, tangential_p = 0, lagmul = 0, output_lambda = 0;
  };
  using Mesh = std::vector<Snapshot<Mpfr>>;

  static Mesh mesh(const Scene& scene, int k, int s, const char* step) {
    SceneRun<Mpfr> run(scene, k, s, step, "1");
    Recorder<Mpfr> recorder;
    run({&recorder});
    return recorder.seen;
  }
  static void raise(Mpfr& error, const Vector<Mpfr>& difference) { raise_to(error, max_norm(difference)); }

  /// Differences from a far finer solution, whose own p is tangential to all digits that matter.
  Errors errors(const Mesh& run, const Mesh& reference) {
    const std::size_t points = 64;
    Errors e;
    for (std::size_t i = 1; i <= points; ++i) {
      const Snapshot<Mpfr>& a = run[i * ((run.size() - 1) / points)];
      const Snapshot<Mpfr>& b = reference[i * ((reference.size() - 1) / points)];
      EXPECT_EQ(a.t, b.t);
      const OutputState<Mpfr> mine = output_state(point, a.q, a.p), exact = output_state(point, b.q, b.p);
      raise(e.q, a.q - b.q);
      raise(e.raw_p, a.p - exact.p);
      raise(e.tangential_p, mine.p - exact.p);
      raise(e.lagmul, a.lambda - exact.lambda);
      raise(e.output_lambda, mine.lambda - exact.lambda);
    }
    return e;
  }

  PrecisionScope digits{36};
  const Scene scene = load_scene(scene_path("double_pendulum"));
  const Assembled<Mpfr> assembled = assemble<Mpfr>(scene);
  StateEvaluator<Mpfr> point{assembled.problem};
};

TEST_P(DoublePendulumOrder, IsThatOfEachComponent) {
  const int s = GetParam();
  const Mesh reference = mesh(scene, 10, 10, "1/64");
  std::vector<Errors> all;
  for (const char* step : {"1/128", "1/256", "1/512"}) all.push_back(errors(mesh(scene, s, s, step), reference));
  const int r = s % 2 == 0 ? s : s + 1;
  for (std::size_t i = 1; i < all.size(); ++i) {
    const auto expect_order = [&](Mpfr Errors::*component, int order, const char* what) {
      EXPECT_NEAR(rate(all[i - 1].*component, all[i].*component), order, 0.2) << what << ", s = " << s;
    };
    expect_order(&Errors::q, 2 * s, "q");
    expect_order(&Errors::tangential_p, 2 * s, "tangential p");
    expect_order(&Errors::output_lambda, 2 * s, "output lambda");
    expect_order(&Errors::raw_p, r, "raw p");
    expect_order(&Errors::lagmul, r - 1, "the extrapolated multiplier (57)");
  }
  EXPECT_GT(all.back().q, literal<Mpfr>("1e-30")) << "at round-off or at the reference's error";
}

INSTANTIATE_TEST_SUITE_P(Stages, DoublePendulumOrder, ::testing::Values(1, 2, 3, 4));

}  // namespace
}  // namespace hbvm::core

#include "integrate/drift.hpp"
#include "integrate/output_state.hpp"
#include "integrate/runs.hpp"
#include "printing.hpp"
#include "step/stepping.hpp"
#include "verification/models.hpp"

namespace hbvm::core {
namespace {

/// The energy error where the potential is no polynomial and the Gram matrix varies: order 2k, whatever s.
using EnergyCase = std::tuple<const char*, int, int>;
class EnergyOrder : public ::testing::TestWithParam<EnergyCase> {
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
  for (std::size_t i = 1; i < errors.size(); ++i) EXPECT_NEAR(order_of(errors[i - 1], errors[i]), 2 * k, 0.2);
}

std::string name_of_case(const ::testing::TestParamInfo<EnergyCase>& info) {
  const auto& [name, k, s] = info.param;
  return std::string(name) + "_" + std::to_string(k) + "_" + std::to_string(s);
}

INSTANTIATE_TEST_SUITE_P(Methods, EnergyOrder,
                         ::testing::ValuesIn(std::vector<EnergyCase>{{"ellipsoid_bead", 1, 1},
                                                                     {"ellipsoid_bead", 2, 1},
                                                                     {"ellipsoid_bead", 3, 1},
                                                                     {"ellipsoid_bead", 2, 2},
                                                                     {"ellipsoid_bead", 3, 2},
                                                                     {"ellipsoid_bead", 3, 3},
                                                                     {"spherical_pendulum", 1, 1},
                                                                     {"spherical_pendulum", 2, 1},
                                                                     {"spherical_pendulum", 2, 2},
                                                                     {"spherical_pendulum", 3, 2}}),
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

  /// Differences from a far finer solution, whose own p is tangential to all digits that matter.
  Errors errors(const Mesh& run, const Mesh& reference) {
    const std::size_t points = 64;
    Errors e;
    for (std::size_t i = 1; i <= points; ++i) {
      const Snapshot<Mpfr>& a = run[i * ((run.size() - 1) / points)];
      const Snapshot<Mpfr>& b = reference[i * ((reference.size() - 1) / points)];
      EXPECT_EQ(a.t, b.t);
      const OutputState<Mpfr> mine = output_state(point, a.q, a.p), exact = output_state(point, b.q, b.p);
      raise_to(e.q, distance(a.q, b.q));
      raise_to(e.raw_p, distance(a.p, exact.p));
      raise_to(e.tangential_p, distance(mine.p, exact.p));
      raise_to(e.lagmul, distance(a.lambda, exact.lambda));
      raise_to(e.output_lambda, distance(mine.lambda, exact.lambda));
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
      EXPECT_NEAR(order_of(all[i - 1].*component, all[i].*component), order, 0.2) << what << ", s = " << s;
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

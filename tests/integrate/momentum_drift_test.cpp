#include "integrate/momentum_drift.hpp"

#include <map>

#include "integrate/runs.hpp"
#include "printing.hpp"

namespace hbvm::core {
namespace {

template <class S>
class MomentumDriftTest : public InDigits<50> {
 protected:
  /// The drift of each conserved component, by name, over a run of HBVM(k, s).
  static std::map<std::string, S> drifts(const std::string& scene, int k, int s) {
    SceneRun<S> run(load_scene(scene), k, s, "1/32", "1");
    MomentumDrift<S> drift(run.scene.problem, conserved_momenta(run.scene.problem));
    run({&drift});
    std::map<std::string, S> result;
    for (std::size_t i = 0; i < drift.components().size(); ++i)
      result.emplace(drift.components()[i].name(), drift.drift(i));
    return result;
  }
  static S round_off() { return 10'000 * epsilon<S>(); }
};
TYPED_TEST_SUITE(MomentumDriftTest, AllScalars, ScalarNames);

TYPED_TEST(MomentumDriftTest, IsTheGreatestChangeSinceTheStart) {
  using S = TypeParam;
  Problem<S> problem;
  problem.dimension = 2;
  problem.mass.add_scalar(2, S(1));
  problem.blocks = {{0, true}};
  const auto axes = coordinate_momenta(problem);
  MomentumDrift<S> drift(problem, {axes[1], axes[2]});
  Snapshot<S> snapshot;
  snapshot.q = Vector<S>::Unit(2, 0);
  snapshot.p = Vector<S>::Zero(2);
  // P_y = L_z = p_y at q = (1, 0)
  for (const int p_y : {5, 6, 2, 4}) {
    snapshot.p[1] = p_y;
    drift.observe(snapshot);
    ++snapshot.n;
  }
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(drift.initial(i), 5);
    EXPECT_EQ(drift.drift(i), 3);
  }
}

/// Gauss collocation keeps quadratic invariants, more nodes do not; linear momentum is kept by all.
TYPED_TEST(MomentumDriftTest, OfAngularMomentumIsRoundOffForGaussOnly) {
  using S = TypeParam;
  for (const char* scene : {"kepler", "tethered_satellites", "quartic_oscillator"}) {
    const auto gauss = this->drifts(scene, 2, 2), more = this->drifts(scene, 4, 2);
    EXPECT_FALSE(gauss.empty()) << scene;
    S greatest = 0;
    for (const auto& [name, drift] : gauss) {
      EXPECT_LE(drift, this->round_off()) << scene << " " << name;
      raise_to(greatest, more.at(name));
    }
    EXPECT_GT(greatest, S(1) / 1'000'000'000'000) << scene;
  }
}

TYPED_TEST(MomentumDriftTest, OfLinearMomentumIsAlwaysRoundOff) {
  for (const char* scene : {"free_rigid_body", "charged_tetrahedron"}) {
    for (const int k : {2, 3}) {
      const auto drifts = this->drifts(scene, k, 2);
      int linear = 0;
      for (const auto& [name, drift] : drifts) {
        if (!name.starts_with("P_")) continue;
        ++linear;
        EXPECT_LE(drift, this->round_off()) << scene << " " << name << ", k = " << k;
      }
      EXPECT_GT(linear, 0) << scene;
    }
  }
}

}  // namespace
}  // namespace hbvm::core

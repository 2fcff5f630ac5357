#include <gtest/gtest.h>

#include <cstdlib>

#include "integrate/coefficient_decay.hpp"
#include "scene/assemble.hpp"
#include "scene/scene.hpp"
#include "step/halving_stepper.hpp"
#include "step/hbvm_stepper.hpp"
#include "step/raising_stepper.hpp"
#include "step/rattle.hpp"
#include "step/registry.hpp"
#include "step/runge_kutta_stepper.hpp"

// Counts every allocation of the program: Eigen, MPFR and the standard library come down to malloc.
#ifndef __SANITIZE_ADDRESS__
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
}

namespace {
long allocations = 0;
}

extern "C" {
void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
void* realloc(void* old, std::size_t size) {
  ++allocations;
  return __libc_realloc(old, size);
}
void* calloc(std::size_t n, std::size_t size) {
  ++allocations;
  return __libc_calloc(n, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
}

namespace hbvm::core {
namespace {

TEST(Allocations, AreCounted) {
  const long before = allocations;
  std::vector<double> v(100);
  EXPECT_EQ(allocations, before + 1) << v[0];
}

/// The first two steps may create what later ones use again.
template <Scalar S, class Stepping>
long allocations_of(Stepping& stepping, const Assembled<S>& scene, StepObserver<S>* observer = nullptr) {
  State<S> state(scene.q0, scene.p0);
  const S h = S(1) / 100;
  const auto make_steps = [&](int steps) {
    for (int i = 0; i < steps; ++i) {
      const StepResult<S> step = stepping.step(state, h);
      if (observer) observer->observe(step, state);
    }
  };
  make_steps(2);
  const long before = allocations;
  make_steps(10);
  return allocations - before;
}

template <Scalar S>
void expect_none(const char* name, SolverKind kind) {
  const Assembled<S> scene = assemble<S>(load_scene(name));
  for (const auto& [k, s] : {std::pair(1, 1), {4, 2}, {3, 3}}) {
    const Hbvm<S> method = make_hbvm<S>(k, s);
    HbvmStepper<S> stepper(scene.problem, method, kind);
    EXPECT_EQ(allocations_of<S>(stepper, scene), 0) << name << ", " << name_of(kind) << ", " << k << "," << s;
  }
}

TEST(AWatchedStep, AllocatesNothing) {
  const auto expect = []<Scalar S>(const S& step) {
    for (const char* name : {"double_pendulum", "heavy_top"})
      for (const int s : {1, 3}) {
        const Assembled<S> scene = assemble<S>(load_scene(name));
        const Hbvm<S> method = make_hbvm<S>(s, s);
        HbvmStepper<S> stepper(scene.problem, method, SolverKind::fixed_point);
        CoefficientDecay<S> decay(scene.problem, s, step);
        EXPECT_EQ(allocations_of<S>(stepper, scene, &decay), 0) << name << s;
      }
  };
  expect(1 / double{100});
  const PrecisionScope digits(50);
  expect(Mpfr(Mpfr(1) / 100));
}

constexpr SolverKind kinds[] = {SolverKind::automatic, SolverKind::newton, SolverKind::fixed_point, SolverKind::paper};

TEST(AStep, AllocatesNothingInDouble) {
  for (const auto& [name, text] : built_in_scenes())
    for (const SolverKind kind : kinds) expect_none<double>(name.c_str(), kind);
}

TEST(AStep, AllocatesNothingInQuad) {
  for (const char* name : {"tethered_satellites", "heavy_top"})
    for (const SolverKind kind : kinds) expect_none<Quad>(name, kind);
}

/// MPFR's own sine and exponential allocate: scenes without them.
TEST(AStep, AllocatesNothingInMpfr) {
  for (const unsigned digits : {30U, 50U, 100U}) {
    const PrecisionScope scope(digits);
    for (const char* name : {"simple_pendulum", "double_pendulum", "kepler", "heavy_top", "bead_on_ellipsoid", "chain",
                             "charged_tetrahedron"})
      for (const SolverKind kind : kinds) expect_none<Mpfr>(name, kind);
  }
}

/// More than an interval of them, so that some are examined.
template <Scalar S>
void expect_none_where_nodes_may_be_raised_and_steps_divided(const char* name) {
  const Assembled<S> scene = assemble<S>(load_scene(name));
  NodeLog log;
  const S h = S(1) / 100;
  HalvingStepper<S> stepper([&](int) {
    return std::make_unique<RaisingStepper<S>>(scene.problem, HbvmName{std::same_as<S, double> ? 16 : 40, 2},
                                               SolverKind::fixed_point, log);
  });
  State<S> state(scene.q0, scene.p0);
  for (int i = 0; i < 2; ++i) stepper.step(state, h);
  const long before = allocations;
  for (int i = 0; i < 2 * RaisingStepper<S>::interval; ++i) stepper.step(state, h);
  EXPECT_EQ(allocations - before, 0) << name;
  EXPECT_TRUE(log.raised.empty());
}

TEST(AStep, ThatWatchesItsNodesAllocatesNothing) {
  const PrecisionScope digits(50);
  for (const char* name : {"kepler", "charged_tetrahedron", "charged_double_pendulum"}) {
    expect_none_where_nodes_may_be_raised_and_steps_divided<double>(name);
    expect_none_where_nodes_may_be_raised_and_steps_divided<Mpfr>(name);
  }
}

TEST(AStep, OfRattleAllocatesNothing) {
  const Assembled<double> scene = assemble<double>(load_scene("tethered_satellites"));
  Rattle<double> rattle(scene.problem);
  EXPECT_EQ(allocations_of<double>(rattle, scene), 0);
}

TEST(AStep, OfEnergyMomentumAndAProjectedOneAllocateNothing) {
  const PrecisionScope digits(50);
  for (const char* const name : {"heavy_top", "chain", "kepler", "charged_tetrahedron"})
    for (const char* const method : {"energy_momentum", "projected_hbvm:2,2"}) {
      const Assembled<double> scene = assemble<double>(load_scene(name));
      const auto step = parse_method(method)->make_stepper(scene.problem, SolverKind::automatic);
      EXPECT_EQ(allocations_of<double>(*step, scene), 0) << method << ' ' << name;
      const Assembled<Mpfr> more = assemble<Mpfr>(load_scene(name));
      const auto step_of_more = parse_method(method)->make_stepper(more.problem, SolverKind::automatic);
      EXPECT_EQ(allocations_of<Mpfr>(*step_of_more, more), 0) << method << ' ' << name;
    }
}

TEST(AStep, OfARungeKuttaMethodAllocatesNothing) {
  const PrecisionScope digits(50);
  const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene("kepler"));
  const Hbvm<Mpfr> gauss = make_hbvm<Mpfr>(2, 2);
  const RungeKutta<Mpfr> implicit{gauss.A, gauss.b, gauss.c};
  RungeKutta<Mpfr> strictly_lower = implicit;
  strictly_lower.A(0, 0) = strictly_lower.A(0, 1) = strictly_lower.A(1, 1) = 0;
  for (const RungeKutta<Mpfr>& method : {implicit, strictly_lower}) {
    RungeKuttaStepper<Mpfr> step(scene.problem, method);
    EXPECT_EQ(allocations_of<Mpfr>(step, scene), 0);
  }
}

}  // namespace
}  // namespace hbvm::core
#endif

#include "hard_cases/scenes.hpp"

#include <gtest/gtest.h>

#include <array>

#include "problem/state_evaluator.hpp"
#include "scalar/literal.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {
namespace {

TEST(HardScenes, AreConsistent) {
  for (const char* const d : {"1e-2", "1e-6"})
    for (const Scene& scene :
         {beside_kepler(d), beside_kepler(d, d), kepler(d), kepler(d, false), double_pendulum("1", d, d),
          near_upright(d), charge_below(d), near_collision(d), flat_triangle(d), stretched_rods(d), folding_linkage(d),
          rods_in_line(d), spring_pendulum(d), oscillator(d), pendulum_with_spring(d), weak_gravity(d)})
      EXPECT_NO_THROW(assemble<Quad>(scene)) << scene.name << " of " << d;
  for (const Scene& scene :
       {earth_moon_satellite(), argon_pair(), whip(5), beads_on_sphere(3), scaled_pendulum(3, -4, 5)})
    EXPECT_NO_THROW(assemble<Quad>(scene)) << scene.name;
}

/// In other units of length, mass and time: energies are mass length^2 / time^2, to the last bit.
TEST(HardScenes, OfOtherUnitsAreTheSame) {
  const auto energy = [](const Scene& text) {
    const Assembled<Quad> scene = assemble<Quad>(text);
    return StateEvaluator<Quad>(scene.problem).energy(scene.q0, scene.p0);
  };
  const Quad unit = energy(scaled_pendulum(0, 0, 0));
  EXPECT_NE(unit, 0);
  for (const auto& [length, mass, time] : {std::array{3, 0, 0}, {0, -4, 0}, {0, 0, 5}, {2, 3, -7}})
    EXPECT_EQ(energy(scaled_pendulum(length, mass, time)), ldexp(unit, mass + 2 * length - 2 * time));
}

/// At the pericentre 1 - e, at the apocentre 1 + e, of the orbit of half axis 1: H = -1/2.
TEST(HardScenes, OfKeplerAreOneOrbit) {
  for (const char* const eccentricity : {"0", "1/2", "0.99"})
    for (const bool at_pericentre : {true, false}) {
      const Assembled<Quad> scene = assemble<Quad>(kepler(eccentricity, at_pericentre));
      const Quad e = evaluate<Quad>(Expression::parse(eccentricity), {});
      EXPECT_LE(abs(Quad(abs(scene.q0[0]) - (at_pericentre ? Quad(1 - e) : Quad(1 + e)))), 4 * epsilon<Quad>());
      EXPECT_LE(abs(Quad(StateEvaluator<Quad>(scene.problem).energy(scene.q0, scene.p0) + Quad(1) / 2)),
                1000 * epsilon<Quad>());
    }
}

TEST(HardScenes, HaveAsManyBodiesAsAskedFor) {
  EXPECT_EQ(whip(5).bodies.size(), 5u);
  EXPECT_EQ(beads_on_sphere(7).bodies.size(), 7u);
}

}  // namespace
}  // namespace hbvm::core

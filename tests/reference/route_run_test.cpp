#include "reference/route_run.hpp"

#include "printing.hpp"
#include "reference/scene_tables.hpp"
#include "reference/taylor.hpp"

namespace hbvm::core {
namespace {

/// The two routes on motions with constraints, and none of them in the other's code: to all digits but a few.
TEST(Routes, Agree) {
  for (const char* name : {"modified_pendulum", "tethered_satellites", "double_pendulum"}) {
    const Scene text = load_scene(name);
    constexpr unsigned digits = 45;
    const PrecisionScope scope(digits);
    const Assembled<Mpfr> scene = assemble<Mpfr>(text);
    const std::vector<Mpfr> at{literal<Mpfr>("1/3"), Mpfr(2)};
    double done = 0;
    const RouteProgress progress = [&done](double part) { done = part; };
    const RouteRun a = taylor_route({text, scene, at, progress, {digits}});
    const RouteRun b = hbvm_route({text, scene, at, progress, {digits}}, 3);
    EXPECT_NEAR(done, 1, 1e-12);
    ASSERT_EQ(a.points.size(), 2u);
    const Mpfr tolerance = literal<Mpfr>("1e-34");
    for (std::size_t n = 0; n < 2; ++n) {
      EXPECT_LE(distance(a.points[n].q, b.points[n].q), tolerance) << name;
      EXPECT_LE(distance(a.points[n].p, b.points[n].p), tolerance) << name;
      EXPECT_LE(distance(a.points[n].lambda, b.points[n].lambda), tolerance * 100) << name;
    }
  }
}

/// A pendulum loses a digit or two, a chaotic motion many: what nature_of says is what a change of the start does.
TEST(Routes, KnowHowErrorsGrow) {
  const auto no_progress = [](double) {};
  const std::vector<Expression> times{Expression::parse("60")};
  const double regular = nature_of(load_scene("simple_pendulum"), times, no_progress).digits_lost;
  EXPECT_GT(regular, 0);
  EXPECT_LT(regular, 3);
  const Scene chaotic = load_scene("chaotic_double_pendulum");
  const MotionNature nature = nature_of(chaotic, times, no_progress);
  EXPECT_GT(nature.log2_radius, -10);
  EXPECT_LT(nature.log2_radius, 5);
  const PrecisionScope scope(80);
  const Assembled<Mpfr> scene = assemble<Mpfr>(chaotic);
  Vector<Mpfr> tilted = scene.p0;
  for (Index j = 0; j < tilted.size(); ++j) tilted[j] += (j + 1) * literal<Mpfr>("1e-50");
  TaylorMotion one(scene.problem, scene.q0, scene.p0), other(scene.problem, scene.q0, tilted);
  one.advance_to(Mpfr(60));
  other.advance_to(Mpfr(60));
  const Mpfr change = distance(one.q(), other.q());
  ASSERT_GT(change, 0);
  const double grown = 50 + approximately(Mpfr(log10(change)));
  EXPECT_GT(grown, 4);
  EXPECT_NEAR(nature.digits_lost, grown, grown / 2);
}

/// Digits that are lost before need not be carried on: a leg has its own. Constants of the scene are no doubles.
TEST(Routes, TakeFewerDigitsTowardsTheEnd) {
  const Scene text = load_scene("chaotic_double_pendulum");
  const std::vector<Expression> times{Expression::parse("5"), Expression::parse("30")};
  const MotionNature nature = nature_of(text, times, [](double) {});
  EXPECT_EQ(nature.to_come(0), nature.digits_lost);
  for (double part = 0; part < 1; part += 0.01) {
    EXPECT_LE(nature.to_come(part + 0.01), nature.to_come(part));
    EXPECT_GE(nature.to_come(part), 0);
  }
  EXPECT_LT(nature.to_come(1), 1);
  constexpr unsigned most = 60;
  const PrecisionScope scope(most);
  const Assembled<Mpfr> scene = assemble<Mpfr>(text);
  const std::vector<Mpfr> at{Mpfr(5), Mpfr(30)};
  const RouteRun all = taylor_route({text, scene, at, [](double) {}, {most}});
  const RouteWork legs{text, scene, at, [](double) {}, {60, 55, 50, 45}};
  for (const RouteRun& fewer : {taylor_route(legs), hbvm_route(legs, 3)}) {
    EXPECT_NE(fewer.settings.find("60 to 45 digits"), std::string::npos) << fewer.settings;
    for (std::size_t n = 0; n < at.size(); ++n) {
      const Mpfr off = distance(fewer.points[n].q, all.points[n].q);
      EXPECT_LE(off, literal<Mpfr>("1e-38")) << fewer.settings;
    }
    EXPECT_GT(distance(fewer.points[1].q, all.points[1].q), literal<Mpfr>("1e-50")) << "as many digits as before";
  }
}

/// A change is one of each body's own size. In SI units a kick in parts of the Earth's momentum would send a satellite
/// out of the solar system.
TEST(Routes, KnowHowErrorsOfUnevenMassesGrow) {
  const std::string uneven = "dimension = 2\n" + body("planet", "5.9e24", "[0, 0]", "[0, -12]") +
                             body("moon", "7.4e22", "[3.8e8, 0]", "[0, 1000]") +
                             body("satellite", "800", "[0, 4.2e7]", "[-3060, 0]") +
                             effect("mutual_gravity", "strength = \"6.67e-11\"");
  const MotionNature nature = nature_of(read_scene(uneven, "uneven"), {Expression::parse("86400")}, [](double) {});
  EXPECT_LT(nature.digits_lost, 3);
  EXPECT_LT(nature.steps, 100);
}

}  // namespace
}  // namespace hbvm::core

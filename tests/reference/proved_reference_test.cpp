#include "reference/proved_reference.hpp"

#include <cmath>
#include <cstdlib>
#include <iostream>

#include "hbvm/error.hpp"
#include "printing.hpp"
#include "reference/random_scene.hpp"
#include "reference/request_of.hpp"
#include "reference/scene_tables.hpp"
#include "reference/taylor.hpp"
#include "scalar/literal.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

Reference proved(ReferenceRequest request) {
  request.prove = true;
  return compute_reference(request);
}

/// A decimal is within its radius, and half a unit of its last digit, of one with more digits.
void expect_within(const std::vector<std::string>& found, const std::string& radius,
                   const std::vector<std::string>& more, int count, const std::string& what) {
  const PrecisionScope digits(100);
  ASSERT_EQ(found.size(), more.size()) << what;
  // To so many digits after the leading one of the greatest component.
  Mpfr greatest = 0;
  for (const std::string& x : found) raise_to(greatest, magnitude(literal<Mpfr>(x)));
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Mpfr off = magnitude(Mpfr(literal<Mpfr>(found[i]) - literal<Mpfr>(more[i])));
    EXPECT_LE(off, literal<Mpfr>(radius) + greatest * literal<Mpfr>("1e-" + std::to_string(count))) << what << " " << i;
  }
}

/// Proved digits are those of two routes with 20 more.
TEST(ProvedReference, HasTheDigitsOfTheRoutes) {
  for (const char* name : {"double_pendulum", "tethered_satellites", "four_bar_linkage", "scissors"}) {
    const Reference proof = proved(request_of(name, {"1/2", "2"}, 20)),
                    more = compute_reference(request_of(name, {"1/2", "2"}, 40));
    EXPECT_EQ(proof.proved, 20);
    EXPECT_EQ(more.proved, 0);
    ASSERT_EQ(proof.routes.size(), 1u);
    EXPECT_EQ(proof.routes[0].name, "proof");
    for (std::size_t n = 0; n < 2; ++n) {
      const ReferenceState &a = proof.times[n], &b = more.times[n];
      ASSERT_TRUE(a.radius.has_value());
      EXPECT_FALSE(b.radius.has_value());
      expect_within(a.q, a.radius->q, b.q, 20, name);
      expect_within(a.p, a.radius->p, b.p, 20, name);
      expect_within(a.lambda, a.radius->lambda, b.lambda, 20, name);
      expect_within({a.H}, a.radius->H, {b.H}, 20, name);
      EXPECT_LT(std::stod(a.radius->q), 1e-20) << name;
    }
  }
}

/// What the field lost: bumps and walls that no point of a step feels.
TEST(ProvedReference, HoldsWhatNoPointOfAStepFeels) {
  const Scene bump = read_scene(
      "dimension = 2\n" + body("a", "1", "[1, 0]", "[0, 0]") + formula("-x^2/2 - y^2/2 - exp(-((x - 1/5)*1000)^2)/4"),
      "bump");
  const Reference proof = proved(request_of(bump, {"3"}, 15));
  // By quadrature of the time that each passage takes.
  EXPECT_EQ(proof.times[0].q[0].substr(0, 18), "-0.989896411825884");
}

/// Scenes of all kinds over many orders of size: each is proved or refused. What is proved is what the routes find
/// with 20 digits more. With HBVM_FULL in the environment there are two hundred, and each is listed.
TEST(ProvedReference, OfRandomScenesIsNeverWrong) {
  const bool all = std::getenv("HBVM_FULL") != nullptr;
  const int scenes = all ? 200 : 4;
  int found = 0, refused = 0;
  for (std::uint64_t seed = 1'000; found + refused < scenes; ++seed) {
    SCOPED_TRACE(seed);
    ReferenceRequest request;
    Reference more;
    try {
      request.scene = read_scene(RandomScene(seed).text(), "random");
      request.digits = 36;
      {
        const PrecisionScope digits(30);
        const Assembled<Mpfr> assembled = assemble<Mpfr>(request.scene);
        const TaylorMotion motion(assembled.problem, assembled.q0, assembled.p0);
        if (!all && assembled.problem.m() > 8) continue;
        constexpr long any = 10;
        request.times = {
            Expression::parse(fmt::format("2^({})", std::min(std::lround(motion.least_radius()) + 1, any)))};
      }
      more = compute_reference(request);
    } catch (const Error&) {
      continue;  // no motion until then, or none that two routes find
    }
    request.digits = 16;
    try {
      const Reference proof = proved(request);
      const ReferenceState &a = proof.times[0], &b = more.times[0];
      ++found;
      expect_within(a.q, a.radius->q, b.q, 16, "q");
      expect_within(a.p, a.radius->p, b.p, 16, "p");
      expect_within(a.lambda, a.radius->lambda, b.lambda, 16, "lambda");
      if (all)
        std::cout << fmt::format("{}: {}, {:.1f} s\n", seed, proof.routes[0].settings, proof.routes[0].cpu_seconds);
    } catch (const Error& error) {
      ++refused;
      std::cout << fmt::format("{}: {}\n", seed, error.what());
    }
  }
  EXPECT_LE(refused, scenes / 10);
}

TEST(ProvedReference, SeesQuantitiesInItsBounds) {
  ReferenceRequest request = request_of("simple_pendulum", {"1"}, 20);
  request.scene = load_scene("simple_pendulum");
  request.scene.observations.push_back(
      {"angle", Expression::parse("angle(pivot, bob)", Expression::Syntax::observation)});
  const Reference proof = proved(request);
  ASSERT_EQ(proof.times[0].observed.size(), 1u);
  const PrecisionScope digits(40);
  const Mpfr x = literal<Mpfr>(proof.times[0].q[0]), y = literal<Mpfr>(proof.times[0].q[1]);
  EXPECT_LT(magnitude(Mpfr(literal<Mpfr>(proof.times[0].observed[0]) - atan2(y, x))), literal<Mpfr>("1e-19"));
}

/// A start that is consistent to its own digits only has no exact motion.
TEST(ProvedReference, NeedsAnExactStart) {
  const Scene scene =
      read_scene("dimension = 2\n" + point("o", "[0, 0]") +
                     body("a", "1", "[\"0.70710678118654752440\", \"-0.70710678118654752440\"]", "[0, 0]") +
                     "[[constraint]]\nkind = \"rod\"\nbetween = [\"o\", \"a\"]\nlength = 1\n" + field("[0, -1]"),
                 "rounded");
  try {
    proved(request_of(scene, {"1"}, 30));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("there is no exact start"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace hbvm::core

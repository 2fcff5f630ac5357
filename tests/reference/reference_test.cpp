#include "hbvm/reference/reference.hpp"

#include "hbvm/error.hpp"
#include "hbvm/scalar/literal.hpp"
#include "printing.hpp"
#include "reference/known_motion.hpp"

namespace hbvm {
namespace {

ReferenceRequest request_of(const char* scene, const std::vector<const char*>& times, int digits) {
  ReferenceRequest request;
  request.scene = load_scene(scene);
  for (const char* t : times) request.times.push_back(Expression::parse(t));
  request.digits = digits;
  return request;
}

/// Every digit but the last is that of the closed form, and the last is off by one half; as many are there as were
/// asked for after the leading one of the greatest component, and no more.
TEST(ReferenceSolution, HasTheDigitsOfClosedForms) {
  for (const int digits : {5, 30, 80})
    for (const char* name : {"simple_pendulum", "conical_pendulum"}) {
      const Reference reference = compute_reference(request_of(name, {"1/2", "3"}, digits));
      ASSERT_EQ(reference.times.size(), 2u);
      EXPECT_EQ(reference.routes.size(), 3u);
      const PrecisionScope scope(200);
      for (const ReferenceState& state : reference.times) {
        EXPECT_GT(state.agreed, digits);
        const ExactPoint exact = known_motion(name, literal<Mpfr>(state.t));
        const auto compare = [&](const std::vector<std::string>& texts, const Vector<Mpfr>& values) {
          const Mpfr size = max_norm(values);
          // 10^(leading - digits), with the leading exponent of the greatest component.
          Mpfr unit = 1;
          while (unit > size) unit /= 10;
          while (unit * 10 <= size) unit *= 10;
          for (int i = 0; i < digits; ++i) unit /= 10;
          for (std::size_t j = 0; j < texts.size(); ++j) {
            const Mpfr error = magnitude(Mpfr(literal<Mpfr>(texts[j]) - values[static_cast<Index>(j)]));
            EXPECT_LE(error, unit * 501 / 1000) << name << " " << state.t << " " << texts[j];
            std::size_t count = 0;
            for (const char c : texts[j].substr(0, texts[j].find('e'))) count += c >= '0' && c <= '9';
            EXPECT_LE(count, static_cast<std::size_t>(digits) + 3) << texts[j];
          }
        };
        compare(state.q, exact.q);
        compare(state.p, exact.p);
      }
    }
}

TEST(ReferenceSolution, OfAChaoticMotionHasItsDigitsToo) {
  const Reference few = compute_reference(request_of("double_pendulum", {"12"}, 12)),
                  many = compute_reference(request_of("double_pendulum", {"12"}, 30));
  const PrecisionScope scope(50);
  for (std::size_t j = 0; j < few.times[0].q.size(); ++j)
    EXPECT_LE(magnitude(Mpfr(literal<Mpfr>(few.times[0].q[j]) - literal<Mpfr>(many.times[0].q[j]))),
              literal<Mpfr>("1e-12"));
}

TEST(ReferenceSolution, ByOneRouteConfirmsNothing) {
  ReferenceRequest request = request_of("simple_pendulum", {"1"}, 20);
  const Reference both = compute_reference(request);
  for (const Route route : all_routes) {
    request.only = route;
    const Reference one = compute_reference(request);
    ASSERT_EQ(one.routes.size(), 1u);
    EXPECT_EQ(one.routes[0].name, name_of(route));
    EXPECT_EQ(one.times[0].agreed, 0);
    EXPECT_EQ(one.times[0].q, both.times[0].q);
    EXPECT_EQ(one.times[0].lambda, both.times[0].lambda);
  }
}

/// The closed form is one of the routes where there is one, and is refused where there is none.
TEST(ReferenceSolution, TakesClosedFormsWhereTheyAreKnown) {
  const Reference kepler = compute_reference(request_of("kepler", {"3"}, 20)),
                  chaotic = compute_reference(request_of("double_pendulum", {"1/2"}, 10));
  ASSERT_EQ(kepler.routes.size(), 3u);
  EXPECT_EQ(kepler.routes[2].name, "closed_form");
  EXPECT_EQ(kepler.routes[2].settings.substr(0, 29), "closed form: Kepler's problem");
  EXPECT_EQ(chaotic.routes.size(), 2u);
  ReferenceRequest request = request_of("double_pendulum", {"1/2"}, 10);
  request.only = Route::closed_form;
  EXPECT_THROW(compute_reference(request), InputError);
}

TEST(ReferenceSolution, RefusesWhatItCannotGive) {
  EXPECT_THROW(compute_reference(request_of("simple_pendulum", {}, 20)), InputError);
  EXPECT_THROW(compute_reference(request_of("simple_pendulum", {"0"}, 20)), InputError);
  EXPECT_THROW(compute_reference(request_of("simple_pendulum", {"2", "1"}, 20)), InputError);
  EXPECT_THROW(compute_reference(request_of("simple_pendulum", {"1"}, 0)), InputError);
  EXPECT_THROW(compute_reference(request_of("simple_pendulum", {"1e400"}, 20)), InputError);
  EXPECT_THROW(compute_reference(request_of("simple_pendulum", {"1", "1e30"}, 20)), InputError);
  EXPECT_THROW(compute_reference(request_of("simple_pendulum", {"1"}, most_reference_digits + 1)), InputError);
  EXPECT_THROW(parse_route("euler"), InputError);
}

TEST(ReferenceSolution, EndsWhereItsOwnerEndsIt) {
  struct Ended {};
  ReferenceRequest request = request_of("tethered_satellites", {"10"}, 20);
  request.progress = [](double part) {
    if (part > 0) throw Ended();
  };
  EXPECT_THROW(compute_reference(request), Ended);
}

TEST(ReferenceSolution, KnowsItsSceneByWhatItSays) {
  Scene scene = load_scene("simple_pendulum");
  const std::string hash = scene_hash(scene);
  scene.name = scene.title = "another";
  EXPECT_EQ(scene_hash(scene), hash);
  scene.bodies.front().mass = Expression::parse("2");
  EXPECT_NE(scene_hash(scene), hash);
}

}  // namespace
}  // namespace hbvm

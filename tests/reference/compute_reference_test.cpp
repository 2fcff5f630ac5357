#include "reference/compute_reference.hpp"

#include "printing.hpp"
#include "reference/agreement.hpp"
#include "reference/closed_form/rigid_scenes.hpp"
#include "reference/known_motion.hpp"
#include "reference/request_of.hpp"
#include "reference/store.hpp"

namespace hbvm::core {
namespace {

/// Every digit but the last is that of the closed form, and the last is off by one half. As many are there as were
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
  for (const std::vector<const char*>& times :
       {std::vector<const char*>{}, {"0"}, {"2", "1"}, {"1e400"}, {"1", "1e30"}})
    EXPECT_THROW(compute_reference(request_of("simple_pendulum", times, 20)), InputError);
  for (const int digits : {0, most_reference_digits + 1})
    EXPECT_THROW(compute_reference(request_of("simple_pendulum", {"1"}, digits)), InputError);
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

/// Forces of short range that the start does not feel, with values that were found by quadrature. Steps that were
/// chosen at points alone passed by them, and both routes agreed on the motion without them.
TEST(ReferenceSolution, SeesForcesBetweenThePoints) {
  struct Case {
    std::string toml;
    const char *t, *q_1;
    int digits;
  };
  const std::string at_rest = body("a", "1", "[1, 0]", "[0, 0]"),
                    wide = at_rest + formula("-x^2/2 - y^2/2 - exp(-((x - 0.2)/1e-3)^2)/4"),
                    narrow = at_rest + formula("-x^2/2 - y^2/2 - exp(-((x - 0.2)/1e-5)^2)/4"),
                    grains = body("a", "1", "[-2, 0]", "[1, 0]") + body("b", "1", "[2, \"1/50\"]", "[-1, 0]") +
                             effect("formula", "between = [\"a\", \"b\"]\nU = \"-exp(-200*r)/r\""),
                    wall = point("o", "[0, 0]") + body("a", "1", "[\"-0.6\", \"-0.8\"]", "[0, 0]") +
                           rod("o", "a", "1") + field("[0, \"-9.81\"]") + formula("-exp((x - 0.05)/0.001)");
  for (const Case& c : {Case{wide, "3", "-0.98989641182588406", 17},
                        {narrow, "3", "-0.98999153801451", 14},
                        {grains, "4", "1.3458191561146427323", 19},
                        {wall, "2", "-0.535628851862", 12}}) {
    const Scene scene = read_scene("dimension = 2\n" + c.toml, "short_range");
    const Reference found = compute_reference(request_of(scene, {c.t}, c.digits));
    const PrecisionScope scope(40);
    EXPECT_LE(magnitude(Mpfr(literal<Mpfr>(found.times[0].q[0]) - literal<Mpfr>(c.q_1))),
              pow(Mpfr(10), -c.digits) * 6 / 10)
        << found.times[0].q[0];
  }
}

/// A route that is off by a part in 10^8 in one component, whichever route and component. Nothing is given out, and
/// both values are said.
TEST(ReferenceSolution, GivesNothingOutWhereARouteIsWrong) {
  for (const Route liar : all_routes)
    for (const std::size_t kind : {0, 1, 2}) {
      const auto wrong = [&](Route route) -> RouteFunction {
        const RouteFunction right = function_of(route);
        if (route != liar) return right;
        return [right, kind](const RouteWork& work, double digits) {
          std::optional<RouteRun> run = right(work, digits);
          ExactPoint& at = run->points.back();
          Vector<Mpfr>& x = kind == 0 ? at.q : kind == 1 ? at.p : at.lambda;
          x[x.size() - 1] *= 1 + literal<Mpfr>("1e-8");
          return run;
        };
      };
      try {
        compute_reference(request_of("simple_pendulum", {"1", "3"}, 15), wrong);
        FAIL() << name_of(liar) << " was believed";
      } catch (const Disagreement& found) {
        EXPECT_EQ(found.t, "3");
        EXPECT_EQ(found.component, kind == 0 ? "q_2" : kind == 1 ? "p_2" : "lambda_1");
        ASSERT_EQ(found.values.size(), 3u);
        for (const auto& [route, number] : found.values) expect_words(found.what(), {number + " by " + route});
      }
    }
}

/// A closed form that fails leaves the others, and any other route that fails ends all.
TEST(ReferenceSolution, NeedsTwoRoutes) {
  const auto failing = [](Route broken) {
    return [broken](Route route) -> RouteFunction {
      if (route != broken) return function_of(route);
      return [](const RouteWork&, double) -> std::optional<RouteRun> { throw IntegrationError("it fails"); };
    };
  };
  const ReferenceRequest request = request_of("simple_pendulum", {"3"}, 15);
  EXPECT_EQ(compute_reference(request, failing(Route::closed_form)).routes.size(), 2u);
  EXPECT_THROW(compute_reference(request, failing(Route::taylor)), IntegrationError);
  EXPECT_THROW(compute_reference(request, failing(Route::hbvm)), IntegrationError);
}

/// A body that tumbles end over end: two components of its angular momentum are 0 but for rounding, in some route.
TEST(ReferenceSolution, MeasuresWhatVanishesByItsVector) {
  const RigidScene tumbling{.position = "[0, 0, 0]",
                            .velocity = "[0, 0, 0]",
                            .mass = "1",
                            .second_moment = "[[1, 0, 0], [0, 1, 0], [0, 0, 2]]",
                            .directors = "[[1, 0, 0], [0, 1, 0], [0, 0, 1]]",
                            .omega = "[1, 0, 0]"};
  const Reference found = compute_reference(request_of(read_scene(tumbling.text(), "tumbling"), {"3"}, 10));
  EXPECT_GT(found.times[0].agreed, 10);
  EXPECT_EQ(found.routes.size(), 3u);
}

/// What would take years is refused before it begins, with what it would take.
TEST(ReferenceSolution, RefusesWhatCannotEnd) {
  const ReferenceRequest both_routes = request_of("double_pendulum", {"50"}, 5000);
  ReferenceRequest one_route = request_of("double_pendulum", {"5000"}, 5000);
  one_route.only = Route::taylor;
  for (const ReferenceRequest& request : {both_routes, one_route})
    expect_words(message_of([&] { compute_reference(request); }), {"would take about", "--force"});
}

/// With very many digits HBVM takes longer than a proof, which is made instead: of what has no closed form, and starts
/// exactly.
TEST(ComputeReference, ProvesByItselfWhatThatMakesCheaper) {
  const Reference found = compute_reference(request_of("double_pendulum", {"1/4"}, 220));
  EXPECT_EQ(found.proved, 220);
  ASSERT_EQ(found.routes.size(), 1u);
  EXPECT_EQ(found.routes[0].name, "proof");
  ReferenceRequest alone = request_of("double_pendulum", {"1/4"}, 220);
  alone.only = Route::taylor;
  EXPECT_EQ(differences(found, compute_reference(alone)).size(), 0u);
  EXPECT_EQ(compute_reference(request_of("double_pendulum", {"1/4"}, 60)).proved, 0);
  EXPECT_EQ(compute_reference(request_of("simple_pendulum", {"1/4"}, 220)).proved, 0);
}

}  // namespace
}  // namespace hbvm::core

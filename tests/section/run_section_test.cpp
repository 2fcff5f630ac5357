#include "section/run_section.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "door/section_of.hpp"
#include "hbvm/reference.hpp"
#include "printing.hpp"
#include "reference/agreement.hpp"
#include "scalar/literal.hpp"
#include "scalar/log2_of.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

/// Henon and Heiles' motions of one energy that start on the axis of y.
constexpr const char* family =
    "dimension = 2\n"
    "constants = { E = '1/8', y0 = 0 }\n"
    "body = [{ name = 'star', mass = 1, position = [0, 'y0'], velocity = ['sqrt(2*E - y0^2 + 2*y0^3/3)', 0] }]\n"
    "effect = [{ kind = 'formula', U = '-(x^2 + y^2)/2 - x^2*y + y^3/3' }]\n";

SectionRequest asked(const std::string& precision, const std::string& method) {
  SectionRequest request{.scene = hbvm::read_scene(family, "family"),
                         .plane = "star.x",
                         .axes = {"star.y", "star.vy"},
                         .starts = {"y0=1/10,3/10"},
                         .method = method,
                         .step = "1/8",
                         .until = "20"};
  request.precision = precision;
  return request;
}

/// The exact motion of an orbit is in the plane at the times of its points, and where they say.
TEST(SectionTest, HasPointsOfTheExactMotion) {
  const Section found = *run_section(section_work(asked("mpfr:30", "hbvm:12,12")), {});
  ASSERT_EQ(found.orbits.size(), 2u);
  const SectionOrbit& orbit = found.orbits[1];
  ASSERT_EQ(orbit.points.size(), 3u);
  hbvm::ReferenceRequest reference{.scene = hbvm::read_scene(family, "family"), .times = {}, .digits = 25};
  reference.scene.set("y0", "3/10");
  for (const SectionPoint& point : orbit.points) reference.times.emplace_back(point.t);
  const PrecisionScope scope(40);
  const std::vector<hbvm::ReferenceState> states = hbvm::reference(reference).times;
  for (std::size_t n = 0; n < states.size(); ++n) {
    EXPECT_LT(std::abs(std::stod(states[n].q[0])), 1e-24);
    EXPECT_GT(std::stod(states[n].p[0]), 0) << "the plane is crossed downwards";
    EXPECT_LT(log10_of(Mpfr(literal<Mpfr>(states[n].q[1]) - literal<Mpfr>(orbit.points[n].x))), -23);
    EXPECT_LT(log10_of(Mpfr(literal<Mpfr>(states[n].p[1]) - literal<Mpfr>(orbit.points[n].y))), -23);
  }
}

/// In any number of threads, in shards, and from what was kept.
TEST(SectionTest, IsTheSameHoweverItIsMade) {
  SectionRequest request = asked("double", "hbvm:4,4");
  request.starts = {"y0=-1/10:4/10:4", "E=1/10,1/8"};
  const SectionWork work = section_work(request);
  CellStore store;
  CellOptions options;
  options.store = &store;
  options.shard = {1, 2};
  EXPECT_FALSE(run_section(work, options));
  options.shard = {2, 2};
  const std::optional<Section> put_together = run_section(work, options);
  CellOptions threads;
  threads.jobs = 3;
  const Section all = *run_section(work, threads);
  ASSERT_TRUE(put_together);
  EXPECT_EQ(to_json(*put_together), to_json(all));
  EXPECT_EQ(all.orbits.size(), 8u);
  ASSERT_EQ(all.orbits[1].start.size(), 2u);
  for (std::size_t n = 0; n < 2; ++n) EXPECT_EQ(all.orbits[1].start[n], work.starts[1].values[n].text());
}

/// A start that there is not is told, and leaves the others.
TEST(SectionTest, TellsOfStartsThatThereAreNot) {
  SectionRequest request = asked("double", "hbvm:4,4");
  request.starts = {"y0=1/10,5"};
  const Section found = *run_section(section_work(request), {});
  EXPECT_TRUE(found.orbits[0].failure.empty());
  EXPECT_FALSE(found.orbits[1].failure.empty());
  EXPECT_TRUE(found.orbits[1].points.empty());
  request.starts = {"y0=5"};
  EXPECT_THROW(run_section(section_work(request), {}), InputError);
}

}  // namespace
}  // namespace hbvm::core

#include "integrate/trajectory.hpp"

#include <sstream>

#include "integrate/output_state.hpp"
#include "integrate/runs.hpp"
#include "integrate/trajectory_columns.hpp"
#include "printing.hpp"
#include "solver/error_of.hpp"
#include "solver/falling_stone.hpp"
#include "verification/models.hpp"

namespace hbvm::core {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text)
    if (c == separator)
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

/// A trajectory's lines: the names, then numbers alone.
struct Csv {
  std::string names;
  std::vector<std::vector<std::string>> rows;
  explicit Csv(const std::string& text) {
    EXPECT_EQ(text.back(), '\n');
    for (const std::string& line : split(text.substr(0, text.size() - 1), '\n'))
      if (names.empty())
        names = line;
      else
        rows.push_back(split(line, ','));
  }
};

template <Scalar S>
std::string trajectory_of(SceneRun<S>& run, long every, const std::vector<std::string>& columns = {"t"},
                          Recorder<S>* recorder = nullptr) {
  std::ostringstream text;
  Trajectory<S> trajectory(run.scene.problem, text, every, run.grid.steps(), columns);
  std::vector<Observer<S>*> observers{&trajectory};
  if (recorder) observers.push_back(recorder);
  run(observers);
  return text.str();
}

/// As many names as there are numbers, whatever the scene.
TEST(Trajectory, NamesItsColumnsFirst) {
  for (const char* const name : {"double_pendulum", "heavy_top", "kepler", "double_physical_pendulum"}) {
    const Scene scene = load_scene(name);
    SceneRun<double> run(scene, 2, 2, "1/100", "1/50");
    const auto columns = names_of(trajectory_columns(scene, names_of_constraints(run.scene.problem)));
    const Csv csv(trajectory_of<double>(run, 1, columns));
    EXPECT_EQ(split(csv.names, ','), columns);
    ASSERT_EQ(csv.rows.size(), 3u);
    for (const auto& row : csv.rows) EXPECT_EQ(row.size(), columns.size()) << name;
  }
}

TEST(Trajectory, QuotesNames) {
  SceneRun<double> run(load_scene("simple_pendulum"), 1, 1, "1/8", "1/8");
  EXPECT_EQ(Csv(trajectory_of<double>(run, 1, {"t", "a,b.x", "\"c\".x"})).names, "t,\"a,b.x\",\"\"\"c\"\".x\"");
}

TEST(Trajectory, WithoutConstraintsHasNoMultipliers) {
  SceneRun<double> run(
      read_scene("dimension = 2\n[[body]]\nname = \"a\"\nmass = 1\nposition = [0, 0]\nvelocity = [1, 0]\n", "free"), 1,
      1, "1", "3");
  const Csv csv(trajectory_of<double>(run, 1));
  EXPECT_EQ(csv.rows[3], (std::vector<std::string>{"3", "3", "0", "1", "0", "1", "0", "0", "0", "0"}));
}

TEST(Trajectory, HasEveryNthAndTheLastMeshPoint) {
  const auto times = [](long every) {
    SceneRun<double> run(load_scene("simple_pendulum"), 1, 1, "1/8", "5/4");
    std::vector<std::string> result;
    for (const auto& row : Csv(trajectory_of<double>(run, every)).rows) result.push_back(row[0]);
    return result;
  };
  using Texts = std::vector<std::string>;
  EXPECT_EQ(times(1).size(), 11u);
  EXPECT_EQ(times(3), (Texts{"0", "0.375", "0.75", "1.125", "1.25"}));
  EXPECT_EQ(times(5), (Texts{"0", "0.625", "1.25"}));
  EXPECT_EQ(times(10), (Texts{"0", "1.25"}));
  EXPECT_EQ(times(1'000), (Texts{"0", "1.25"}));
}

template <class S>
class TrajectoryNumbers : public InDigits<50> {};
TYPED_TEST_SUITE(TrajectoryNumbers, AllScalars, ScalarNames);

TYPED_TEST(TrajectoryNumbers, ReadBackAsTheSameValues) {
  using S = TypeParam;
  SceneRun<S> run(load_scene(scene_path("ellipsoid_bead")), 2, 2, "1/10", "1");
  Recorder<S> recorder;
  const Csv csv(trajectory_of<S>(run, 1, {"t"}, &recorder));
  ASSERT_EQ(csv.rows.size(), recorder.seen.size());
  StateEvaluator<S> point(run.scene.problem);
  const S H0 = point.energy(run.scene.q0, run.scene.p0);
  for (std::size_t n = 0; n < csv.rows.size(); ++n) {
    const Snapshot<S>& s = recorder.seen[n];
    const OutputState<S> output = output_state(point, s.q, s.p);
    std::vector<S> expected{s.t};
    for (const Vector<S>& v : {s.q, s.p, s.lambda, output.p, output.lambda})
      expected.insert(expected.end(), v.begin(), v.end());
    expected.push_back(point.energy(s.q, s.p) - H0);
    expected.push_back(max_norm(point.constraints(s.q)));
    expected.push_back(max_norm(point.hidden_constraints(s.q, s.p)));
    ASSERT_EQ(csv.rows[n].size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i)
      EXPECT_EQ(literal<S>(csv.rows[n][i]), expected[i]) << n << ", " << i;
  }
}

TEST(Trajectory, IsWrittenUpToAFailure) {
  SceneRun<double> run(falling_stone("1"), 2, 2, "1/50", "2");
  std::ostringstream text;
  Trajectory<double> trajectory(run.scene.problem, text, 1, run.grid.steps(), {"t"});
  const auto error = error_of<StepError>([&] { run({&trajectory}); });
  EXPECT_EQ(Csv(text.str()).rows.size(), static_cast<std::size_t>(error.step()));
}

}  // namespace
}  // namespace hbvm::core

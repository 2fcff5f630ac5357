#include "integrate/checkpoint.hpp"

#include <csignal>
#include <filesystem>
#include <sstream>

#include "checksum.hpp"
#include "folder.hpp"
#include "hbvm/error.hpp"
#include "integrate/drift.hpp"
#include "integrate/momentum_drift.hpp"
#include "integrate/runs.hpp"
#include "integrate/trajectory.hpp"
#include "interrupting.hpp"
#include "printing.hpp"
#include "solver/error_of.hpp"
#include "step/stepping.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

template <class S>
class Memory : public InDigits<50> {};
TYPED_TEST_SUITE(Memory, AllScalars, ScalarNames);

constexpr SolverKind all_solvers[] = {SolverKind::automatic, SolverKind::newton, SolverKind::fixed_point,
                                      SolverKind::paper};

TYPED_TEST(Memory, OfEverySolverIsComplete) {
  for (const SolverKind solver : all_solvers) {
    expect_memory<TypeParam>("hbvm:3,2", "charged_double_pendulum", "1/16", solver, 14);
    expect_memory<TypeParam>("hbvm:4,2", "kepler", "1/16", solver, 14);
    expect_memory<TypeParam>("hbvm:3,2,4", "bead_on_quartic", "1/16", solver, 14);
  }
}

/// With the small step Newton in double keeps its Jacobian over several steps, with the large one it has to renew it.
TYPED_TEST(Memory, OfNewtonHoldsItsJacobianAndItsRate) {
  for (const char* step : {"1/256", "1/8", "1/3"})
    expect_memory<TypeParam>("hbvm:3,3", "triple_pendulum", step, SolverKind::newton, 12);
}

/// In double the fixed point becomes slow in these, or fails.
constexpr std::pair<const char*, const char*> switching[] = {
    {"charged_tetrahedron", "1/2"}, {"four_bar_linkage", "1/3"}, {"spring_and_plane", "1"}};

TYPED_TEST(Memory, OfTheAutomaticChoiceHoldsTheChoice) {
  for (const auto& [scene, step] : switching)
    expect_memory<TypeParam>("hbvm:3,3", scene, step, SolverKind::automatic, 12);
}

TEST(Memory, OfTheAutomaticChoiceIsTestedWhereItSwitches) {
  int switched = 0;
  for (const auto& [scene, step] : switching) {
    SceneRun<double> run(load_scene(scene), 3, 3, step, (std::string(step) + "*12").c_str(), SolverKind::automatic);
    const auto has_newton = [&] { return calls_of(run.stepper.counts(), "corrections") >= 0; };
    run.step();
    const bool at_once = has_newton();
    for (int n = 1; n < 12; ++n) run.step();
    switched += !at_once && has_newton();
  }
  EXPECT_GE(switched, 2);
}

/// All that an integration gathers, its trajectory and its end, as text.
template <Scalar S>
struct Gathered {
  SceneRun<S> run;
  std::ostringstream csv;
  Drift<S> drift;
  MomentumDrift<S> momenta;
  Trajectory<S> trajectory;

  Gathered()
      : run(load_scene("kepler"), 3, 2, "1/16", "12", SolverKind::automatic),
        drift(run.scene.problem),
        momenta(run.scene.problem, conserved_momenta(run.scene.problem)),
        trajectory(run.scene.problem, csv, 5, run.grid.steps(), {"a name"}) {}

  std::string operator()(Checkpoints* checkpoints, Observer<S>* last = nullptr) {
    std::vector<Observer<S>*> observers{&drift, &momenta, &trajectory};
    if (last) observers.push_back(last);
    Integration<S> result = integrate<S>(run.stepper, run.state, run.grid, observers, checkpoints);
    Archive all;
    all(result.end.n, result.end.t, result.end.q, result.end.p, result.end.lambda, result.steps, result.sweeps,
        run.state, drift, momenta, trajectory);
    EXPECT_FALSE(momenta.components().empty());
    return all.text();
  }
};

/// Asks for an end after step n, and writes down nothing.
template <Scalar S>
struct EndAfter final : Observer<S> {
  long n;
  explicit EndAfter(long last) : n(last) {}
  ~EndAfter() override { interruption = 0; }
  void observe(const Snapshot<S>& snapshot) override {
    if (snapshot.n == n) interruption = SIGTERM;
  }
  void remember(Archive&) override {}
};

TYPED_TEST(Memory, OfAnIntegrationIsComplete) {
  using S = TypeParam;
  const Folder folder;
  Gathered<S> whole;
  const std::string expected = whole(nullptr);
  long step = 0;
  for (const long n : {0, 1, 2, 70, 150}) {
    const std::string file = folder / "run";
    std::string lines;
    {
      Gathered<S> first;
      EndAfter<S> end(n);
      Checkpoints checkpoints(file, 1e9, {});
      const auto interrupted = error_of<Interrupted>([&] { first(&checkpoints, &end); });
      EXPECT_EQ(interrupted.signal(), SIGTERM);
      expect_words(interrupted.what(), {"SIGTERM after step "});
      lines = first.csv.str();
    }
    interruption = 0;
    Gathered<S> second;
    EndAfter<S> none(-1);
    Checkpoints checkpoints(file, 1e9, {});
    checkpoints.resume(read_checkpoint(file).state);
    EXPECT_EQ(second(&checkpoints, &none), expected) << "interrupted after step " << n;
    EXPECT_EQ(lines + second.csv.str(), whole.csv.str());
    step = n;
  }
  EXPECT_EQ(step, 150);
}

/// A stepper whose third step a signal ends half-way.
class EndedWithinAStep final : public ForwardingStepper<double> {
 public:
  using ForwardingStepper::ForwardingStepper;
  StepResult<double> step(State<double>& state, const double& h) override {
    if (++steps_ < 3) return inner().step(state, h);
    state.q[0] += 1;
    interruption = SIGTERM;
    end_if_asked("half-way");
    return {};
  }
  void remember(Archive& archive) override {
    ForwardingStepper::remember(archive);
    archive(steps_);
  }

 private:
  long steps_ = 0;
};

struct Last final : Observer<double> {
  long n = -1;
  void observe(const Snapshot<double>& snapshot) override { n = snapshot.n; }
  void remember(Archive&) override {}
};

TEST(Checkpoints, AreNotMadeOfAStepThatASignalEnded) {
  const Folder folder;
  const std::string file = folder / "run";
  SceneRun<double> run(load_scene("simple_pendulum"), 1, 1, "1/8", "1");
  EndedWithinAStep stepper(run.stepper);
  Last shown;
  Checkpoints checkpoints(file, 1e9, {});
  expect_words(
      message_of<Interrupted>([&] { integrate<double>(stepper, run.state, run.grid, {&shown}, &checkpoints); }),
      {"after step 2,"});
  interruption = 0;
  EXPECT_EQ(shown.n, 2);
  // The one made at the start.
  Archive kept(read_checkpoint(file).state);
  long n = -1;
  kept(n);
  EXPECT_EQ(n, 0);
}

TEST(Checkpoints, AreWrittenAtTheStartWhenDueAndAtTheEnd) {
  const Folder folder;
  const std::string file = folder / "run";
  struct Count final : Observer<double> {
    long remembered = 0;
    void observe(const Snapshot<double>&) override {}
    void remember(Archive&) override { ++remembered; }
  };
  const auto written = [&](double seconds) {
    SceneRun<double> run(load_scene("kepler"), 2, 2, "1/16", "12");
    Count count;
    Checkpoints checkpoints(file, seconds, {});
    integrate<double>(run.stepper, run.state, run.grid, {&count}, &checkpoints);
    return count.remembered;
  };
  EXPECT_EQ(written(1e9), 2);
  EXPECT_GE(written(0), 1 + 192 / 64);
  EXPECT_FALSE(std::filesystem::exists(file + ".part"));
}

TEST(Checkpoints, AreRefusedWhereAnObserverCannotBeKept) {
  const Folder folder;
  SceneRun<double> run(load_scene("kepler"), 2, 2, "1/16", "12");
  Recorder<double> recorder;
  Checkpoints checkpoints(folder / "run", 60, {});
  EXPECT_THROW(integrate<double>(run.stepper, run.state, run.grid, {&recorder}, &checkpoints), InputError);
}

std::string sealed(const std::string& text) { return text + "checksum " + Checksum(text).text() + "\n"; }

class CheckpointFile : public ::testing::Test {
 protected:
  const Folder folder;
  const std::string file = folder / "run";

  void expect_refused(const std::string& text, const std::string& words) const {
    folder.write("run", text);
    expect_words(message_of([&] { read_checkpoint(file); }), {words, file});
  }
};

TEST_F(CheckpointFile, IsReadAsItWasWritten) {
  const Checkpoint written{{"1.2", "name", "a = 1\nb = 2\n", "", {{"--step", "1/2"}, {"--reverse", "true"}}}, "1\n2\n"};
  write_checkpoint(file, written);
  const Checkpoint read = read_checkpoint(file);
  EXPECT_EQ(read.identity.program, "1.2");
  EXPECT_EQ(read.identity.scene_name, "name");
  EXPECT_EQ(read.identity.scene, written.identity.scene);
  EXPECT_EQ(read.identity.options, written.identity.options);
  EXPECT_EQ(read.state, "1\n2\n");
}

TEST_F(CheckpointFile, IsRefusedWithEveryByteFlippedAndCutAnywhere) {
  write_checkpoint(file, {{"1.2", "name", "scene", "", {}}, "1\n2\n"});
  const std::string whole = text_of(file);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    for (const int bit : {1, 32}) {
      std::string flipped = whole;
      flipped[i] = static_cast<char>(flipped[i] ^ bit);
      expect_refused(flipped, "is ");
    }
    expect_refused(whole.substr(0, i), i == 0 ? "is empty" : "is ");
  }
  expect_refused(whole + "\n", "is damaged");
}

TEST_F(CheckpointFile, IsRefusedIfItIsNoneOrOfAnotherVersion) {
  expect_refused("dimension = 2\n", "no checkpoint");
  expect_refused(sealed("hbvm checkpoint 5\n1\n"), "format '5' of another version");
  expect_refused(sealed("hbvm checkpoint 3\n1\n"), "format '3' of another version");
  expect_refused(sealed("hbvm checkpoint 4\n5\n"), "fit");
  EXPECT_THROW(read_checkpoint(folder / "none"), InputError);
  EXPECT_THROW(read_checkpoint(folder / ""), InputError);
}

TEST_F(CheckpointFile, OverwritesNothingButACheckpoint) {
  folder.write("run", "precious");
  EXPECT_THROW(Checkpoints(file, 60, {}), InputError);
  EXPECT_THROW(write_checkpoint(file, {}), InputError);
  EXPECT_EQ(text_of(file), "precious");
  EXPECT_THROW(Checkpoints("", 60, {}), InputError);
  EXPECT_THROW(Checkpoints("/nonexistent/run", 60, {}), InputError);
  EXPECT_THROW(Checkpoints(folder / "", 60, {}), InputError);
  folder.write("run", "");
  write_checkpoint(file, {});
  write_checkpoint(file, {});
  EXPECT_EQ(read_checkpoint(file).state, "");
}

}  // namespace
}  // namespace hbvm::core

#include <fmt/format.h>

#include <algorithm>
#include <random>

#include "printing.hpp"
#include "reference/scene_tables.hpp"
#include "scene/assemble.hpp"
#include "step/hbvm_stepper.hpp"

namespace hbvm::core {
namespace {

/// Bodies on a grid with random offsets, some hung from the one before by a rod, at rest, and some effects.
struct RandomScene {
  std::mt19937 random;
  int dimension, bodies;

  explicit RandomScene(unsigned seed) : random(seed), dimension(2 + pick(2)), bodies(1 + pick(4)) {}
  int pick(int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); }

  std::string text() {
    const std::string origin = dimension == 2 ? "[0, 0]" : "[0, 0, 0]";
    std::vector<std::vector<int>> at{std::vector<int>(static_cast<std::size_t>(dimension), 0)};  // hundredths
    std::string result = fmt::format("dimension = {}\n", dimension) + point("0", origin);
    for (int b = 1; b <= bodies; ++b) {
      std::vector<int> x;
      for (int j = 0; j < dimension; ++j) x.push_back((j == 0 ? 120 * b : 0) + pick(60) - 30);
      std::string position;
      for (const int value : x) position += fmt::format("{}\"{}/100\"", position.empty() ? "" : ", ", value);
      result += body(std::to_string(b), fmt::format("\"{}/4\"", 1 + pick(12)), "[" + position + "]", origin,
                     fmt::format("charge = {}\n", 1 + pick(3)));
      at.push_back(x);
    }
    for (int b = 1; b <= bodies; ++b) {
      if (pick(4) == 0) continue;
      long squared = 0;
      for (std::size_t j = 0; j < at[0].size(); ++j) {
        const long d = at[static_cast<std::size_t>(b)][j] - at[static_cast<std::size_t>(b - 1)][j];
        squared += d * d;
      }
      result += rod(std::to_string(b - 1), std::to_string(b), fmt::format("\"sqrt({})/100\"", squared));
    }
    if (pick(2) == 0) result += field(dimension == 2 ? "[0.1, -1]" : "[0, 0.2, -1]");
    if (pick(2) == 0) result += effect("trap", "center = \"0\"\nstiffness = 0.5\nexponent = 4");
    if (pick(3) == 0) result += effect("radial_cosine", "center = \"0\"\nstrength = 0.7");
    if (bodies > 1 && pick(2) == 0)
      result += effect("coulomb", fmt::format("strength = 0.3\nbetween = [[\"1\", \"{}\"]]", bodies));
    if (bodies > 1 && pick(2) == 0)
      result += effect("spring", "stiffness = 2\nrest_length = 0.8\nbetween = [[\"1\", \"2\"]]");
    return result;
  }
};

template <Scalar S>
State<S> end_of(const Scene& text, int k, int s, SolverKind kind, int r = 0) {
  const Assembled<S> scene = assemble<S>(text);
  const Hbvm<S> method = make_hbvm<S>(k, s, std::max(r, s));
  HbvmStepper<S> stepper(scene.problem, method, kind);
  State<S> state(scene.q0, scene.p0);
  for (int step = 0; step < 6; ++step) stepper.step(state, S(S(1) / 20));
  return state;
}

/// To the state of the solver of the paper after six steps, but for rounding.
template <Scalar S>
void expect_agreement(const Scene& text, int k, int s, int r = 0) {
  const State<S> expected = end_of<S>(text, k, s, SolverKind::paper, r);
  for (const SolverKind kind : {SolverKind::fixed_point, SolverKind::newton, SolverKind::automatic}) {
    const State<S> end = end_of<S>(text, k, s, kind, r);
    // Unknowns are of order 10, and six steps magnify their round-off.
    const S bound = 2000 * epsilon<S>();
    const std::string what = fmt::format("{} {} {},{},{}", text.name, name_of(kind), k, s, r);
    EXPECT_LE(distance(end.q, expected.q), bound) << what;
    EXPECT_LE(distance(end.p, expected.p), bound) << what;
  }
}

template <class S>
class SolversAgree : public InDigits<45> {};
TYPED_TEST_SUITE(SolversAgree, AllScalars, ScalarNames);

TYPED_TEST(SolversAgree, OnFiftyRandomScenesAndMethods) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    RandomScene random(seed);
    const Scene text = read_scene(random.text(), fmt::format("random {}", seed));
    const int s = 1 + random.pick(5), k = s + random.pick(5);
    expect_agreement<TypeParam>(text, k, s);
  }
}

/// Of constraints by any formula, with nodes of their own or without; and of quadratic ones at more nodes than they
/// take.
TYPED_TEST(SolversAgree, OnConstraintsOfAnyKind) {
  for (const char* name : {"bead_on_torus", "bead_on_quartic", "bead_on_helix", "bead_on_cycloid", "rod_on_two_curves",
                           "rope_over_two_pegs", "heavy_top"}) {
    const Scene text = load_scene(name);
    for (const auto& [k, s, r] : {HbvmName{1, 1, 1}, {1, 1, 3}, {2, 2, 2}, {3, 2, 5}, {4, 4, 4}, {4, 4, 5}})
      expect_agreement<TypeParam>(text, k, s, r);
  }
}

}  // namespace
}  // namespace hbvm::core

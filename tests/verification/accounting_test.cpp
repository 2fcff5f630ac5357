// What was not named costs nothing: the accounts of runs, in exact integers.

#include <gtest/gtest.h>

#include <set>

#include "problem/effect/registry.hpp"
#include "reference/scene_tables.hpp"
#include "run/simulate.hpp"

namespace hbvm::core {
namespace {

/// Two charged bodies, a fixed charge, nothing that acts on them.
std::string bodies(int dimension, bool with_rod) {
  const std::string end = dimension == 2 ? "]" : ", 0]";
  return "dimension = " + std::to_string(dimension) + "\n" + point("O", "[0, -1" + end, "charge = 1\n") +
         body("a", "1", "[0, 0" + end, "[0, 1" + end, "charge = 2\n") +
         body("b", "2", "[1, 0" + end, "[0, 0" + end, "charge = 3\n") + (with_rod ? rod("a", "b", "1") : "");
}

/// Every kind of effect on those bodies, weak enough for any sum of them.
std::vector<std::pair<std::string, std::string>> effects(int dimension) {
  const std::string z = dimension == 2 ? "" : ", 0";
  const std::string about = "center = \"O\"\n";
  std::vector<std::pair<std::string, std::string>> result{
      {"uniform_gravity", "acceleration = [0, -0.1" + z + "]"},
      {"central_gravity", about + "strength = 0.1"},
      {"mutual_gravity", "strength = 0.1"},
      {"coulomb", "strength = 0.1"},
      {"spring", "between = [\"a\", \"b\"]\nstiffness = 0.1"},
      {"trap", about + "stiffness = 0.1\nexponent = 2"},
      {"lennard_jones", "depth = 0.01\ndiameter = 1"},
      {"radial_cosine", about + "strength = 0.1"},
      {"oblateness", about + "strength = 0.1\nradius = 1\nJ2 = 0.1\naxis = [0, 1" + z + "]"}};
  for (auto& [kind, text] : result) text = effect(kind, text);
  return result;
}

std::string effect_of(int dimension, const std::string& kind) {
  for (const auto& [name, text] : effects(dimension))
    if (name == kind) return text;
  return {};
}

Account run(const std::string& text, int k, int s, const char* step = "1/16", const char* until = "1/8",
            SolverKind solver = SolverKind::fixed_point) {
  const auto scene = assemble<double>(read_scene(text, "test.toml"));
  Account account;
  simulate(scene, make_hbvm<double>(k, s), solver, TimeGrid<double>(Expression::parse(step), Expression::parse(until)),
           {}, &account);
  return account;
}

/// The account of so many sweeps over the stage equations, whatever they converge to. It is in quad, where products use
/// the parity of the nodes however few there are.
Account sweeps(const std::string& text, int k, int s, int count) {
  const auto scene = assemble<Quad>(read_scene(text, "test.toml"));
  const auto method = make_hbvm<Quad>(k, s);
  StageEquations<Quad> equations(scene.problem, method);
  const Quad h = Quad(1) / 16;
  equations.start({scene.q0, scene.p0, h});
  auto x = equations.make_unknowns();
  x.gamma.row(0) = scene.p0.transpose();
  for (int sweep = 0; sweep < count; ++sweep) {
    equations.move(x.gamma);
    equations.forces(x.psi);
    EXPECT_TRUE(equations.multipliers(x.psi, x.lambda, x.zeta));
    equations.momenta(x.psi, x.zeta, x.gamma);
  }
  return account_of(equations.problem(), {equations.effect_counts(), equations.part_counts()});
}

std::uint64_t evaluations(const Account& account, const std::string& kind) {
  std::uint64_t sum = 0;
  for (const AccountLine& line : account.lines)
    if (line.kind == AccountLine::Kind::effect && line.name == kind) sum += line.evaluations;
  return sum;
}

OperationCounts force_operations(const Account& account) {
  OperationCounts sum;
  for (const AccountLine& line : account.lines)
    if (line.kind == AccountLine::Kind::effect) sum += line.operations;
  return sum;
}

std::vector<AccountLine> solver_lines(const Account& account) {
  std::vector<AccountLine> lines = account.lines;
  std::erase_if(lines, [](const AccountLine& line) { return line.kind != AccountLine::Kind::part; });
  return lines;
}

AccountLine line_of(const Account& account, const std::string& name) {
  for (const AccountLine& line : account.lines)
    if (line.name == name) return line;
  ADD_FAILURE() << "no line '" << name << "'";
  return {};
}

struct Count {
  int add = 0, subtract = 0, multiply = 0, divide = 0, root = 0, negate = 0;
};

OperationCounts operations(const Count& count) {
  OperationCounts result;
  result.add(Op::add, count.add);
  result.add(Op::subtract, count.subtract);
  result.add(Op::multiply, count.multiply);
  result.add(Op::reciprocal, count.divide);
  result.add(Op::sqrt, count.root);
  result.add(Op::negate, count.negate);
  return result;
}

void expect_operations(const Account& account, const std::string& name, std::uint64_t times, const Count& each) {
  const OperationCounts found = line_of(account, name).operations, expected = operations(each);
  for (std::size_t op = 0; op < op_count; ++op)
    EXPECT_EQ(found[static_cast<Op>(op)], times * expected[static_cast<Op>(op)])
        << name << ", " << name_of(static_cast<Op>(op));
}

/// The part that a sweep of the fixed-point iteration has not.
constexpr const char* newtons_part = "hidden constraints at the nodes (52)";

const std::set<std::string> constraint_parts{
    "positions at constraint nodes (48)",       "constraint gradients",
    "matrix for the multipliers (29)",          "LU for the multipliers (29)",
    "right-hand side for the multipliers (29)", "multipliers at the nodes (29)",
    "constraint-force coefficients zeta (49)"};

TEST(Accounting, KnowsEveryEffectOfTheRegistry) {
  std::set<std::string> registered, used;
  std::apply([&](auto... e) { (registered.emplace(decltype(e)::kind), ...); }, Effects{});
  for (const auto& [kind, text] : effects(2)) used.insert(kind);
  EXPECT_EQ(used, registered);
}

TEST(Accounting, AnEffectsCounterIsNotZeroExactlyIfTheSceneNamesIt) {
  const auto all = effects(2);
  for (unsigned subset = 0; subset < 1U << all.size(); ++subset) {
    std::string text = bodies(2, subset % 3 == 0);
    for (std::size_t e = 0; e < all.size(); ++e)
      if (subset >> e & 1) text += all[e].second;
    const Account account = run(text, 2, 1, "1/16", "1/16");
    for (std::size_t e = 0; e < all.size(); ++e) {
      EXPECT_EQ(evaluations(account, all[e].first) != 0, (subset >> e & 1) != 0)
          << all[e].first << " of subset " << subset;
    }
  }
}

TEST(Accounting, ForcesAreEvaluatedAtKNodesASweepAndConstantOnesOnce) {
  std::string text;
  std::uint64_t varying = 0;
  for (const auto& [kind, effect] : effects(2)) {
    text += effect + effect;  // the same kind twice is two effects
    if (kind != "uniform_gravity") varying += 2;
  }
  for (const bool rod : {false, true}) {
    for (const auto solver : {SolverKind::fixed_point, SolverKind::paper}) {
      for (const auto& [k, s] : {std::pair(1, 1), {3, 1}, {2, 2}, {5, 2}, {4, 3}}) {
        const Account account = run(bodies(2, rod) + text, k, s, "1/32", "1/8", solver);
        EXPECT_EQ(account.steps, 4u);
        EXPECT_GT(account.sweeps, account.steps);
        std::uint64_t sum = 0;
        for (const AccountLine& line : account.lines) {
          if (line.kind != AccountLine::Kind::effect) continue;
          const bool constant = line.name == "uniform_gravity";
          EXPECT_EQ(line.calls, constant ? 1 : account.sweeps) << line.name;
          EXPECT_EQ(line.evaluations, constant ? 1 : static_cast<std::uint64_t>(k) * account.sweeps) << line.name;
          sum += line.evaluations;
        }
        EXPECT_EQ(sum, static_cast<std::uint64_t>(k) * account.sweeps * varying + 2);
      }
    }
  }
}

TEST(Accounting, ASceneOfConstantForcesEvaluatesOnceInAll) {
  for (const bool rod : {false, true}) {
    const Account account = run(bodies(2, rod) + effect_of(2, "uniform_gravity"), 4, 2, "1/32", "1");
    EXPECT_EQ(account.steps, 32u);
    EXPECT_EQ(evaluations(account, "uniform_gravity"), 1u);
    EXPECT_EQ(line_of(account, "positions at quadrature nodes (48)").calls, 0u);
  }
}

/// It is added to psi_0 and, as what rounding leaves over, to gamma_0: exact sums, six operations each, of the
/// coordinates it acts on.
TEST(Accounting, AConstantForceCostsTheSolverExactSumsWhereItActs) {
  const std::string along_y = field("[0, -1, 0]");
  const Account without = sweeps(bodies(3, true), 3, 2, 5), with = sweeps(bodies(3, true) + along_y, 3, 2, 5);
  EXPECT_EQ(line_of(with, "force coefficients psi_hat (50)").calls, 5u);
  for (const AccountLine& line : solver_lines(without)) {
    const AccountLine found = line_of(with, line.name);
    EXPECT_EQ(found.calls, line.calls) << line.name;
    OperationCounts expected = line.operations;
    constexpr std::uint64_t pulled = 2, times = 5;
    if (line.name == "force coefficients psi_hat (50)")
      expected += pulled * times * operations({.add = 2, .subtract = 4});
    // The two sums of p0 and its carry are replaced by the two exact ones, the rest's factor and its sums.
    if (line.name == "momentum coefficients gamma (54)" || line.name == "right-hand side for the multipliers (29)")
      expected += pulled * times * operations({.add = 2 * 2 + 4 - 2, .subtract = 2 * 4, .multiply = 1, .negate = 1});
    EXPECT_EQ(found.operations, expected) << line.name;
  }
}

TEST(Accounting, ForceOperationsAreTheSumOverTheEffects) {
  const auto all = effects(3);
  const auto of = [](const std::string& text) { return force_operations(sweeps(bodies(3, true) + text, 3, 2, 5)); };
  std::string together;
  OperationCounts sum;
  for (const auto& [kind, text] : all) {
    together += text;
    sum += of(text);
  }
  EXPECT_EQ(of(together), sum);
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_EQ(of(all[a].second + all[b].second), of(all[a].second) + of(all[b].second))
          << all[a].first << " and " << all[b].first;
}

TEST(Accounting, ForceOperationsOfARunAreItsEvaluationsTimesThoseOfOne) {
  for (const auto& [kind, effect] : effects(3)) {
    const Account one = sweeps(bodies(3, true) + effect, 1, 1, 1), whole = run(bodies(3, true) + effect, 3, 2);
    EXPECT_EQ(evaluations(one, kind), 1u);
    EXPECT_EQ(force_operations(whole), evaluations(whole, kind) * force_operations(one)) << kind;
  }
}

/// Whatever the effects, the solver's lines say the same, as long as there is one that varies.
TEST(Accounting, TheSolversOperationsAreLinesOfTheirOwn) {
  std::string text = bodies(3, true);
  for (const auto& [kind, effect] : effects(3))
    if (kind != "uniform_gravity") text += effect;
  const auto expected = solver_lines(sweeps(text, 3, 2, 5));
  EXPECT_EQ(expected.size(), 12u);
  for (const auto& [kind, effect] : effects(3)) {
    if (kind == "uniform_gravity") continue;
    const auto lines = solver_lines(sweeps(bodies(3, true) + effect, 3, 2, 5));
    ASSERT_EQ(lines.size(), expected.size());
    for (std::size_t i = 0; i < lines.size(); ++i) {
      EXPECT_EQ(lines[i].name, expected[i].name);
      // zeta of the multipliers before they are corrected, and after
      EXPECT_EQ(lines[i].calls, lines[i].name == newtons_part                                ? 0u
                                : lines[i].name == "constraint-force coefficients zeta (49)" ? 10u
                                                                                             : 5u)
          << lines[i].name;
      EXPECT_EQ(lines[i].operations, expected[i].operations) << lines[i].name << " with " << kind;
    }
  }
}

TEST(Accounting, WithoutConstraintsNoConstraintRoutineIsEntered) {
  for (const int dimension : {2, 3}) {
    std::string text;
    for (const auto& [kind, effect] : effects(dimension)) text += effect;
    for (const auto& [k, s] : {std::pair(2, 2), {4, 1}}) {
      for (const bool rod : {true, false}) {
        const Account account = run(bodies(dimension, rod) + text, k, s);
        std::set<std::string> constraint_lines;
        for (const AccountLine& line : solver_lines(account)) {
          const bool constraint = constraint_parts.contains(line.name);
          if (constraint) constraint_lines.insert(line.name);
          if (line.name == newtons_part) continue;
          // For k = s the nodes c are c_hat.
          const bool idle = (!rod && constraint) || (k == s && line.name == "positions at constraint nodes (48)");
          EXPECT_EQ(line.operations.total() != 0, !idle) << line.name;
          if (line.name == "matrix for the multipliers (29)" || line.name == "LU for the multipliers (29)") {
            // Once a step at least; not once a sweep.
            EXPECT_EQ(line.calls >= account.steps && line.calls < account.sweeps, !idle) << line.name;
            continue;
          }
          const std::uint64_t times = line.name == "constraint-force coefficients zeta (49)" ? 2 : 1;
          const bool once_a_step = line.name == "extrapolation" || line.name == "state and multiplier at the end";
          EXPECT_EQ(line.calls, idle ? 0 : once_a_step ? account.steps : times * account.sweeps) << line.name;
        }
        EXPECT_EQ(constraint_lines, constraint_parts);
      }
    }
  }
}

/// Force of one pair: r^2 takes d products and d - 1 sums, 1/r a root and a quotient. c/r^3 takes three products, its d
/// components d more. x = a - b takes d differences, and the sum into both bodies d sums and d differences.
TEST(Accounting, APlanarForceWorksOnTwoCoordinates) {
  for (const int d : {2, 3}) {
    const Account account = sweeps(bodies(d, false) + effect_of(d, "mutual_gravity"), 3, 2, 5);
    expect_operations(account, "mutual_gravity", 3 * 5,
                      {.add = (d - 1) + d, .subtract = d + d, .multiply = d + 3 + d, .divide = 1, .root = 1});
  }
}

/// A harmonic trap on two bodies at a centre away from the origin: x = q - c, the force stiffness x, its sum.
TEST(Accounting, APlanarTrapWorksOnTwoCoordinates) {
  for (const int d : {2, 3}) {
    const Account account = sweeps(bodies(d, false) + effect_of(d, "trap"), 3, 2, 5);
    expect_operations(account, "trap", 3 * 5, {.add = 2 * (d + d), .multiply = 2 * d});
  }
}

/// m = 2 d coordinates, one rod, one mass that is not 1.
TEST(Accounting, APlanarSceneWorksOnTwoCoordinatesABodyThroughout) {
  constexpr int k = 3, s = 2, times = 5;
  for (const int d : {2, 3}) {
    const Account account = sweeps(bodies(d, true) + effect_of(d, "mutual_gravity"), k, s, times);
    const int m = 2 * d;
    const auto expect = [&](const char* part, const Count& each) { expect_operations(account, part, times, each); };
    // Products with coefficients are sums over the even and over the odd polynomials, of which s = 2 has one each. That
    // is half of the multiplications, and a sum and a difference for two mirrored nodes (of k = 3, one is the middle).
    // The middle of the step is q0, its carry and half a displacement.
    expect("velocity coefficients h M^-1 gamma (48)", {.add = 2 * m, .multiply = s * d + s * m + m});
    expect("positions at constraint nodes (48)", {.add = m + s * m, .subtract = m, .multiply = s * m});
    expect("positions at quadrature nodes (48)", {.add = m + k * m, .subtract = m, .multiply = k * m});
    expect("force coefficients psi_hat (50)", {.add = m + m, .subtract = m, .multiply = k * m});
    // At each node x = a - b, x + x for a, minus that for b; and half of the latter, once it is wanted.
    expect("constraint gradients", {.add = s * d, .subtract = s * d, .negate = s * d});
    expect("matrix for the multipliers (29)", {.add = s * s * (m - 1), .multiply = s * s * (m + 1) + s * d});
    // gamma of the multipliers so far, its velocities at the nodes, and what they leave of the constraint (x times the
    // difference of both).
    expect("right-hand side for the multipliers (29)",
           {.add = (s - 1) * m + 2 * m + m + s * (d - 1),
            .subtract = s * m + m + s * d,
            .multiply = s * m + (s - 1) * m + s * m + s * d + s * m + s * d});
    // Two equations: a quotient, a product and two reciprocals to factor, four products to solve; a change is over h.
    expect("LU for the multipliers (29)", {.subtract = 1, .multiply = 1, .divide = 1 + s});
    expect("multipliers at the nodes (29)", {.add = s, .subtract = 2, .multiply = 2 + 2 * s});
    // Twice: of the multipliers so far, and of those corrected. Both bodies share a product.
    expect("constraint-force coefficients zeta (49)",
           {.add = 2 * (s * d + m), .subtract = 2 * (s * d + m), .multiply = 2 * (s * d + s * m)});
    expect("momentum coefficients gamma (54)",
           {.add = (s - 1) * m + 2 * m, .subtract = s * m, .multiply = s * m + (s - 1) * m + s * m});
  }
}

/// With one node and one coefficient there are no products with P and its weight, which are 1.
TEST(Accounting, OneNodeTakesNoProductsWithOne) {
  constexpr int times = 5;
  for (const int d : {2, 3}) {
    const Account account = sweeps(bodies(d, true) + effect_of(d, "mutual_gravity"), 1, 1, times);
    const int m = 2 * d;
    const auto expect = [&](const char* part, const Count& each) { expect_operations(account, part, times, each); };
    expect("right-hand side for the multipliers (29)",
           {.add = 2 * m + d - 1, .subtract = m + d, .multiply = 2 * m + d + d});
    expect("constraint-force coefficients zeta (49)", {.add = 2 * d, .subtract = 2 * d, .multiply = 2 * d});
  }
}

}  // namespace
}  // namespace hbvm::core

#include "scene/assemble.hpp"

#include "scene/assembled.hpp"
#include "scene/joined_bodies.hpp"
#include "scene/mechanism.hpp"
#include "scene/wrong_change.hpp"

namespace hbvm::core {
namespace {

void expect_equal(const Vector<Mpfr>& v, Index first, const std::vector<const char*>& expected) {
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_EQ(v[first + static_cast<Index>(i)], literal<Mpfr>(expected[i]))
        << "entry " << first + static_cast<Index>(i);
}

void expect_near(const Mpfr& a, const Mpfr& b, const Mpfr& scale, const char* what) {
  EXPECT_LE(magnitude(Mpfr(a - b)), 100 * epsilon<Mpfr>() * scale) << what << ": " << to_text(a) << ", " << to_text(b);
}

class EveryKey : public InDigits<50> {
 protected:
  /// The block of three coordinates that starts at `offset`.
  static Vector<Mpfr> block(const Vector<Mpfr>& q, Index offset) { return q.segment(offset, 3); }
  static Mpfr squared(const Vector<Mpfr>& v) { return Mpfr(v.dot(v)); }

  Assembled<Mpfr> scene = assembled<Mpfr>(every_key);
  static constexpr Index a = 0, b = 3, c = 6, top = 9, stone = 18;  // offsets of the coordinates
};

TEST_F(EveryKey, HasBodiesThenRigidBodiesAsCoordinates) {
  EXPECT_EQ(scene.problem.dimension, 3);
  ASSERT_EQ(scene.problem.m(), 3 * 3 + 9 + 12);
  expect_equal(scene.q0, a, {"3/5", "0", "-4/5"});
  expect_equal(scene.q0, b, {"1", "1", "1"});
  expect_equal(scene.q0, c, {"1", "1", "0"});
  expect_equal(scene.q0, top, {"2/3", "2/3", "1/3", "-2/3", "1/3", "2/3", "1/3", "-2/3", "2/3"});
  expect_equal(scene.q0, stone, {"5", "6", "7", "1", "0", "0", "0", "1", "0", "0", "0", "1"});
}

TEST_F(EveryKey, VelocitiesBecomeMomentaAndMomentaStay) {
  expect_equal(scene.p0, a, {"4/5", "0", "3/5"});
  expect_equal(scene.p0, b, {"87/16", "-3/2", "9/8"});
  expect_equal(scene.p0, c, {"2", "-1", "0"});
  // The stone has v = (1, -1, 1/3), and its directors have the rates omega x d = (0, 5, -3), (-5, 0, 2), (3, -2, 0).
  // With m = 4, centre (0, 1/8, 0), p of the reference point is m v + m/8 d2'.
  const Vector<Mpfr> p = scene.p0.segment(stone, 12);
  const Mpfr third = Mpfr(1) / 3, half = Mpfr(1) / 2;
  const Mpfr expected[4][3] = {{4 * 1 - 5 * half, -4, 4 * third + 1},                // m v + m c2 d2'
                               {0, 5, -3},                                           // J11 d1'
                               {half - 10 + 3 * half, -half - 1, half * third + 4},  // m c2 v + J22 d2' + J23 d3'
                               {-5 * half + 9, -6, 1}};                              // J32 d2' + J33 d3'
  for (Index i = 0; i < 12; ++i) expect_near(p[i], expected[i / 3][i % 3], 10, "p");
}

TEST_F(EveryKey, ConstraintsOfRigidBodiesComeFirst) {
  std::vector<std::string> words;
  for (const std::string body : {"top", "stone"})
    for (const char* const directors : {"1 and 1", "1 and 2", "1 and 3", "2 and 2", "2 and 3", "3 and 3"})
      words.push_back(directors + (" of '" + body + "'"));
  for (const char* const kind : {"rod", "quadric", "plane", "angle"}) words.emplace_back(kind);
  ASSERT_EQ(scene.problem.nu(), static_cast<Index>(words.size()));
  for (std::size_t i = 0; i < words.size(); ++i)
    EXPECT_NE(scene.problem.constraints[i].name.find(words[i]), std::string::npos) << scene.problem.constraints[i].name;
}

TEST_F(EveryKey, ConstraintsAreScaledAsTheFormatSays) {
  const Vector<Mpfr> q = generic<Mpfr>(scene.problem.m(), 1);
  StateEvaluator<Mpfr> point(scene.problem);
  const Vector<Mpfr> g = point.constraints(q);
  Index i = 0;
  for (const Index first : {top, stone + 3})
    for (Index x = 0; x < 3; ++x)
      for (Index y = x; y < 3; ++y, ++i) {
        const Mpfr product = block(q, first + 3 * x).dot(block(q, first + 3 * y));
        expect_near(g[i], Mpfr(product - (x == y ? 1 : 0)), 10, "directors");
      }
  const Vector<Mpfr> qa = block(q, a), qb = block(q, b), qc = block(q, c);
  const Mpfr quarter = Mpfr(1) / 4;
  expect_near(g[12], Mpfr(squared(qa) - 1), 10, "rod");
  expect_near(
      g[13],
      Mpfr(qb[0] * qb[0] + 2 * quarter * qb[0] * qb[1] + 2 * qb[1] * qb[1] + qb[2] * qb[2] + qb[0] / 2 - qb[2] - 4), 10,
      "quadric");
  expect_near(g[14], Mpfr(qc[0] + 2 * qc[1] + 2 * qc[2] - 3), 10, "plane");
  expect_near(g[15], Mpfr(qa.dot(Vector<Mpfr>(qc - qb)) - Mpfr(4) / 5), 10, "angle");
}

TEST_F(EveryKey, HiddenConstraintsAreTheirTimeDerivatives) {
  const Vector<Mpfr> q = generic<Mpfr>(scene.problem.m(), 1), p = generic<Mpfr>(scene.problem.m(), 2);
  Vector<Mpfr> v(p.size());
  scene.problem.mass.velocity(lanes(p), lanes(v));
  StateEvaluator<Mpfr> point(scene.problem);
  const Vector<Mpfr> hidden = point.hidden_constraints(q, p);
  // g is quadratic: the central difference is exact.
  const Vector<Mpfr> ahead = point.constraints(Vector<Mpfr>(q + v)), behind = point.constraints(Vector<Mpfr>(q - v));
  for (Index i = 0; i < hidden.size(); ++i) expect_near(hidden[i], Mpfr((ahead[i] - behind[i]) / 2), 1'000, "hidden");
}

TEST_F(EveryKey, EnergyIsTheSumOfTheTable) {
  const Vector<Mpfr> q = generic<Mpfr>(scene.problem.m(), 3);
  const Vector<Mpfr> qa = block(q, a), qb = block(q, b), qc = block(q, c);
  Vector<Mpfr> charge(3), gravity(3), axis(3), top_centre(3), stone_centre(3);
  charge << Mpfr(2), Mpfr(1) / 2, Mpfr(1) / 4;
  gravity << Mpfr(0), Mpfr(-1) / 7, Mpfr(-1);
  axis << Mpfr(1) / 3, Mpfr(2) / 3, Mpfr(2) / 3;
  top_centre = block(q, top) / Mpfr(10) + block(q, top + 3) / Mpfr(5) + block(q, top + 6);
  top_centre[1] += 1;
  top_centre[2] += Mpfr(1) / 2;
  stone_centre = block(q, stone) + block(q, stone + 6) / Mpfr(8);
  const auto distance = [&](const Vector<Mpfr>& x, const Vector<Mpfr>& y) {
    return Mpfr(sqrt(squared(Vector<Mpfr>(x - y))));
  };

  Matrix<Mpfr> M(3, 3);
  M << Mpfr(2), Mpfr(1) / 4, Mpfr(0), Mpfr(1) / 4, Mpfr(1), Mpfr(0), Mpfr(0), Mpfr(0), Mpfr(1);
  Mpfr V = -(2 * gravity.dot(qa) + gravity.dot(Vector<Mpfr>(M * qb)) + gravity.dot(qc) + 3 * gravity.dot(top_centre) +
             4 * gravity.dot(stone_centre));
  const Vector<Mpfr> origin = Vector<Mpfr>::Zero(3);
  V -= literal<Mpfr>("0.3") * (2 / distance(qa, origin) + 1 / distance(qc, origin));
  V -= 2 / (5 * distance(qa, qc));
  V += literal<Mpfr>("0.7") * literal<Mpfr>("-3/2") / distance(qa, charge);
  for (const Mpfr& r : {distance(qa, qb), distance(qc, charge)})
    V += literal<Mpfr>("5/16") * pow(Mpfr(r - Mpfr(1) / 3), 4);
  V += squared(Vector<Mpfr>(qb - qc));
  for (const Vector<Mpfr>& x : {qa, qb, qc, top_centre, stone_centre}) {
    const Mpfr r = distance(x, charge);
    V += pow(r, 4) / 80;
    V -= cos(r) / 2;
  }
  const Mpfr sixth = pow(Mpfr(literal<Mpfr>("9/10") / distance(qa, qb)), 6);
  V += literal<Mpfr>("4/100") * (sixth * sixth - sixth);
  const Mpfr r = distance(qa, charge), z = axis.dot(Vector<Mpfr>(qa - charge)) / r;
  V += literal<Mpfr>("1.5 * 2 * 1.08e-3 / 4 / 2") * (3 * z * z - 1) / (r * r * r);

  StateEvaluator<Mpfr> point(scene.problem);
  const Mpfr H = point.energy(q, Vector<Mpfr>::Zero(q.size()));
  expect_near(H, V, 1'000, "potential energy");
}

/// That a scene is consistent in double, Quad, and `first`, `first` + `step`, ... digits.
void expect_consistent(const std::string& text, unsigned first, unsigned last, unsigned step) {
  EXPECT_EQ(inconsistency<double>(text), "");
  EXPECT_EQ(inconsistency<Quad>(text), "");
  for (unsigned n = first; n <= last; n += step) {
    const PrecisionScope digits(n);
    EXPECT_EQ(inconsistency<Mpfr>(text), "") << n;
  }
}

TEST_F(EveryKey, IsConsistentInEveryPrecision) {
  expect_consistent(every_key, 20, 100, 80);
  expect_consistent(every_key, 1'000, 1'000, 1);
}

/// An angle between a rod and a direction that two fixed points give.
TEST(FixedDirection, GivesALinearConstraint) {
  const PrecisionScope digits(50);
  const std::string fixed = R"(["P", "R"])", moving = R"(["a", "c"])";
  for (const auto& [first, second] : {std::pair(fixed, moving), std::pair(moving, fixed)}) {
    const std::string text = R"(dimension = 3
point = [{ name = "P", position = [0, 0, 1] }, { name = "R", position = [1, 1, 3] }]
body = [{ name = "a", mass = 1, position = [1, 0, 0], velocity = [1, 1, -1] },
        { name = "c", mass = 2, position = [0, "3/2", 1], velocity = [0, 0, 0] }]
constraint = [{ kind = "angle", value = "5/2", first = )" +
                             first + ", second = " + second + " }]\n";
    SCOPED_TRACE(text);
    const Assembled<Mpfr> scene = assembled<Mpfr>(text);
    StateEvaluator<Mpfr> point(scene.problem);
    const Vector<Mpfr> q = generic<Mpfr>(6, 1), p = generic<Mpfr>(6, 2);
    const auto along = [](const Vector<Mpfr>& x) { return Mpfr(-(x[0] - x[3]) - (x[1] - x[4]) - 2 * (x[2] - x[5])); };
    expect_near(point.constraints(q)[0], Mpfr(along(q) - Mpfr(5) / 2), 10, "angle");
    Vector<Mpfr> v(6);
    scene.problem.mass.velocity(lanes(p), lanes(v));
    for (const char* const what : {"its rate", "its rate, evaluated again"})
      expect_near(point.hidden_constraints(q, p)[0], along(v), 10, what);
  }
}

/// The bodies and points of this scene by default: 1, 2 and the points carry charges, 3 does not.
const std::string charges = R"(dimension = 2
point = [{ name = "P", position = [0, 3], charge = 2 }, { name = "Q", position = [0, -3], charge = 5 },
         { name = "R", position = [4, 0] }]
body = [{ name = "1", mass = 1, position = [1, 0], velocity = [0, 0], charge = 7 },
        { name = "2", mass = 1, position = [-1, 0], velocity = [0, 0], charge = -1 },
        { name = "3", mass = 1, position = [0, 0], velocity = [0, 0] }]
[[effect]]
kind = "coulomb"
strength = 3
)";

TEST(DefaultPairs, AreAllThatAnEffectCanActOn) {
  const auto energy_at_start = [](const std::string& text) {
    const Assembled<double> scene = assembled<double>(text);
    return StateEvaluator<double>(scene.problem).energy(scene.q0, scene.p0);
  };
  const double far = std::sqrt(10);
  EXPECT_NEAR(energy_at_start(charges), 3 * (7 * -1 / 2.0 + (7 - 1) * (2 + 5) / far), 1e-13) << "all charges";
  EXPECT_NEAR(energy_at_start(changed(charges, "coulomb", "mutual_gravity")), -3 * (1 / 2.0 + 1 + 1), 1e-13)
      << "all bodies";
  EXPECT_NEAR(energy_at_start(charges + "between = [\"P\", \"2\"]\n"), 3 * 2 * -1 / far, 1e-13) << "those named";
}

TEST(UnusableScene, IsRefusedWithFileAndLine) {
  const char* const rows_of_mass = "[0.25, 1, 0], [0, 0, 1]]";
  const char* const pair = "strength = \"1/5\"\nbetween = [\"a\", \"c\"]";
  expect_refusals(
      inconsistency<double>, every_key,
      {{"mass = 2", "mass = 0", {"'a'", "mass", "positive"}, its_table},
       {"mass = 2", R"(mass = "-L")", {"'a'", "mass", "positive"}, its_table},
       {"mass = 2", R"(mass = "2*K")", {"'a'", "'K'"}, its_table},
       {"mass = 2", "mass = \"1/(L-L)\"", {"'a'", "division"}, its_table},
       {"mass = 2", "mass = 1e-400", {"'a'", "1e-400", "range"}, its_table},
       {R"(L = "1/2")", R"(L = "unit/2")", {"defined by itself"}, "[[point]]\nname = \"charge\""},
       {rows_of_mass, "[0.26, 1, 0], [0, 0, 1]]", {"'b'", "mass matrix", "symmetric"}, its_table},
       {rows_of_mass, R"([0.25, "1/33", 0], [0, 0, 1]])", {"'b'", "mass matrix", "positive definite"}, its_table},
       {rows_of_mass, R"([0.25, "1/32", 0], [0, 0, 1]])", {"'b'", "mass matrix", "positive definite"}, its_table},
       {"mass = 4", "mass = -4", {"'stone'", "mass", "positive"}, its_table},
       {"[0, 0.5, 3]]", "[0, 0.6, 3]]", {"'stone'", "second_moment", "symmetric"}, its_table},
       {"second_moment = [[1", "second_moment = [[-1", {"'stone'", "no body has this 'second_moment'"}, its_table},
       {R"(["1/5", "-1/3", 4]])", R"(["1/5", "-1/3", 3]])", {"'top'", "S = tr(J)/2 I - J + m c c^T"}, its_table},
       {"[0, 2, 0.5], [0, 0.5, 3]]",
        R"([0, "1/16", 0], [0, 0, 3]])",
        {"'stone'", "no thickness", "positive definite"},
        its_table},
       {R"(["1/4", 2, 0], [0, 0, 1]])", R"(["1/5", 2, 0], [0, 0, 1]])", {"quadric", "'A'", "symmetric"}, its_table},
       {R"(length = "unit")", R"(length = "unit-1")", {"rod", "length", "positive"}, its_table},
       {"strength = 0.7", "strength = 0.7\nbetween = [\"a\", \"b\"]", {"coulomb", "'b'", "charge"}, its_table},
       {"strength = 0.7", "strength = 0.7\nbetween = [\"a\", \"pivot\"]", {"coulomb", "'pivot'", "charge"}, its_table},
       {"strength = 0.7",
        "strength = 0.7\nbetween = [\"charge\", \"pivot\"]",
        {"coulomb", "'charge'", "'pivot'"},
        its_table},
       {R"(on = ["a", "c"])", "", {"central_gravity", "'b'", "scalar mass"}, its_table},
       {pair, R"(strength = "1/5")", {"mutual_gravity", "'b'", "scalar mass"}, its_table},
       {pair, "strength = \"1/5\"\nbetween = [\"a\", \"pivot\"]", {"mutual_gravity", "'pivot'", "mass"}, its_table},
       {"stiffness = \"L/10\"\nexponent = 4", "stiffness = \"L/10\"\nexponent = 3", {"trap", "exponent"}, its_table}});
}

/// Each constraint of every_key, by a start that violates it: its number in the problem's order, and the residual.
TEST(InconsistentStart, NamesConstraintAndResidual) {
  const std::string_view rod = "[[constraint]]\nkind = \"rod\"", quadric = "[[constraint]]\nkind = \"quadric\"",
                         plane = "[[constraint]]\nkind = \"plane\"";
  expect_refusals(
      inconsistency<double>, every_key,
      {{R"(length = "unit")", "length = 2", {"position", "constraint 13 (", "rod", "residual -3.00e+00"}, its_table},
       {R"(0.4, 0, "3/10")", "0.4, 0, 0", {"velocity", "constraint 13 (", "rod", "residual 4.80e-01"}, rod},
       {"c = -4", "c = -4.001", {"position", "constraint 14 (", "quadric", "residual -1.00e-03"}, its_table},
       {"-1.5, 1.125]", "-1.5, 1]", {"velocity", "constraint 14 (", "quadric", "residual -1.25e-01"}, quadric},
       {"offset = 3", "offset = 2", {"position", "constraint 15 (", "plane", "residual 1.00e+00"}, its_table},
       {"[2, -1, 0]", "[2, -1, 1]", {"velocity", "constraint 15 (", "plane", "residual 2.00e+00"}, plane},
       {"value = 0.8", "value = 0.9", {"position", "constraint 16 (", "angle", "residual -1.00e-01"}, its_table},
       {"directors = [[1, 0, 0]",
        "directors = [[1, 0.25, 0]",
        {"position", "constraint 7 (", "'stone'", "residual 6.25e-02"},
        its_table}});
}

/// A pendulum on a circle of radius 1.
std::string pendulum(const std::string& position, const std::string& velocity, const std::string& mass = "3") {
  return "dimension = 2\npoint = [{ name = \"o\", position = [0, 0] }]\nbody = [{ name = \"a\", mass = " + mass +
         ", position = " + position + ", velocity = " + velocity + " }]\n" + rod("o", "a", "1");
}

TEST(Consistency, IsJudgedInTheWorkingPrecision) {
  const PrecisionScope digits(50);
  // No decimals, which would be taken for a rounded start and settled.
  const std::string position = pendulum("[\"0.70710678118654752 + 0\", \"-0.70710678118654752 - 0\"]", "[1, 1]"),
                    velocity = pendulum("[\"sqrt(1/2)\", \"-sqrt(1/2)\"]", "[\"0.33333333333333333 + 0\", \"1/3\"]");
  EXPECT_EQ(inconsistency<double>(position), "");
  EXPECT_EQ(inconsistency<double>(velocity), "");
  expect_words(inconsistency<Quad>(position), {"position", "constraint 1", "residual"});
  expect_words(inconsistency<Mpfr>(position), {"position", "constraint 1", "residual -1.24e-17"});
  expect_words(inconsistency<Mpfr>(velocity), {"velocity", "constraint 1", "residual"});
}

TEST(Consistency, HoldsForExactExpressionsAtAnyDigits) {
  expect_consistent(pendulum("[\"sin(1/3)\", \"-cos(1/3)\"]", "[\"7*cos(1/3)\", \"7*sin(1/3)\"]"), 20, 300, 7);
}

TEST(Consistency, FarFromTheOriginAllowsTheRoundOffThere) {
  const std::string text = R"(dimension = 2
body = [{ name = "a", mass = 1, position = [1000000.1, 0.3], velocity = [5, 1] },
        { name = "b", mass = 7, position = [1000000.7, 1.1], velocity = [5, 1] }]
)" + rod("a", "b", "1");
  EXPECT_EQ(inconsistency<double>(text), "");
  EXPECT_NE(inconsistency<double>(changed(text, "length = 1\n", "length = 1.00001\n")), "");
}

TEST(Consistency, OfTheBuiltInScenesHoldsAtAnyPrecision) {
  for (const auto& [name, text] : built_in_scenes()) {
    SCOPED_TRACE(name);
    expect_consistent(text, 20, 200, 9);
  }
}

/// Scenes with more constraints than they need: which are set aside, by number.
struct Overconstrained {
  const char* name;
  std::string text;
  std::vector<Index> redundant;
};

std::string line_of_three(const char* zero) {
  const std::string dimension = std::string(zero).empty() ? "2" : "3";
  const auto body = [&](const char* name, const char* x, const char* v) {
    return "[[body]]\nname = \"" + std::string(name) + "\"\nmass = 1\nposition = [" + x + ", 0" + zero +
           "]\nvelocity = [0, " + v + zero + "]\n";
  };
  return "dimension = " + dimension + "\n" + body("a", "0", "1") + body("b", "1", "0") + body("c", "2", "-1") +
         rod("a", "b", "1") + rod("b", "c", "1") + rod("a", "c", "2");
}

/// Three parallel cranks that carry a triangle.
std::string three_cranks(const char* third_velocity) {
  return std::string(R"(dimension = 2
point = [{ name = "O", position = [0, 0] }, { name = "P", position = [2, 0] }, { name = "Q", position = [1, 1] }]
body = [{ name = "a", mass = 1, position = ["3/5", "4/5"], velocity = [-4, 3] },
        { name = "b", mass = 2, position = ["13/5", "4/5"], velocity = [-4, 3] },
        { name = "c", mass = 3, position = ["8/5", "9/5"], velocity = )") +
         third_velocity + " }]\n" + rod("O", "a", "1") + rod("P", "b", "1") + rod("a", "b", "2") +
         rod("a", "c", "\"sqrt(2)\"") + rod("b", "c", "\"sqrt(2)\"") + rod("Q", "c", "1");
}

std::vector<Overconstrained> overconstrained() {
  const std::string pair = R"(dimension = 2
body = [{ name = "a", mass = 1, position = [0, 0], velocity = [0, 1] },
        { name = "b", mass = "1e-20", position = [3, 4], velocity = [0, 1] }]
)";
  const std::string plane = R"(dimension = 3
body = [{ name = "a", mass = 1, position = [1, 2, 3], velocity = [1, 1, 0] }]
constraint = [{ kind = "plane", body = "a", normal = [0, 0, 1], offset = 3 },
              { kind = "plane", body = "a", normal = [0, 0, "-1e-7"], offset = "-3e-7" }]
)";
  return {{"a doubled rod", pair + rod("a", "b", "5") + rod("b", "a", "5"), {1}},
          {"a rod thrice", pair + rod("a", "b", "5") + rod("a", "b", "5") + rod("b", "a", "5"), {1, 2}},
          {"a rod and an angle",
           pair + rod("a", "b", "5") +
               "[[constraint]]\nkind = \"angle\"\nfirst = [\"a\", \"b\"]\nsecond = [\"b\", \"a\"]\nvalue = -25\n",
           {1}},
          {"a line in the plane", line_of_three(""), {2}},
          {"a line in space", line_of_three(", 0"), {2}},
          {"a plane twice", plane, {1}},
          {"three cranks", three_cranks("[-4, 3]"), {3}}};
}

TEST(Assemble, TheMassOfARigidBodyPullsAtItsCenter) {
  const auto scene = assemble<double>(load_scene("free_rigid_body"));
  const Matrix<double>& M = scene.problem.mass.blocks().front().M;
  const double mass = 2, center[] = {literal<double>("1/5"), literal<double>("-1/10"), literal<double>("1/10")};
  for (Index i = 0; i < 3; ++i)
    for (Index a = 0; a < 3; ++a)
      for (Index j = 0; j < 3; ++j) EXPECT_EQ(M(i, 3 * (a + 1) + j), i == j ? mass * center[a] : 0);
}

TEST(Assemble, SetsRedundantConstraintsAside) {
  for (const auto& [name, text, redundant] : overconstrained()) {
    const auto check = [&, &title = name, &scene_text = text, &expected = redundant]<Scalar S>(S) {
      const PrecisionScope digits(50);
      const auto scene = assembled<S>(scene_text);
      ASSERT_EQ(scene.problem.redundant.size(), expected.size()) << title;
      ASSERT_EQ(scene.redundant.size(), expected.size()) << title;
      for (std::size_t r = 0; r < expected.size(); ++r) {
        EXPECT_EQ(scene.problem.redundant[r].place, expected[r]) << title;
        expect_words(scene.redundant[r].name,
                     {"constraint " + std::to_string(expected[r] + 1), scene.problem.redundant[r].constraint.name});
        EXPECT_FALSE(scene.redundant[r].others.empty()) << title;
      }
      StateEvaluator<S> point(scene.problem);
      EXPECT_TRUE(is_finite(max_norm(point.multiplier(scene.q0, scene.p0)))) << title;
    };
    check(double());
    check(Quad());
    check(Mpfr());
  }
}

TEST(Assemble, RefusesContradictoryConstraints) {
  const PrecisionScope digits(50);
  const std::string cranks = three_cranks("[-4, 3]");
  std::string longer = cranks;
  longer.replace(longer.rfind("length = 1"), 10, "length = 2");
  // The middle one leaves the line at once, which the outer rod does not allow.
  std::string sideways = line_of_three("");
  sideways.replace(sideways.find("velocity = [0, 0]"), 17, "velocity = [0, 1]");
  for (const std::string& message : {inconsistency<double>(longer), inconsistency<Mpfr>(longer)})
    expect_words(message, {"contradictory", "residual", "constraint 6", "-3.00e+00"});
  for (const std::string& message : {inconsistency<double>(sideways), inconsistency<Quad>(sideways)})
    expect_words(message, {"constraint 3 (rod 'a'-'c')", "contradictory", "constraint 1", "constraint 2",
                           "second derivative", "tolerance"});
}

/// Of a start rounded to the digits of a double, or of fewer.
TEST(Assemble, SettlesAStartThatIsConsistentToItsOwnDigits) {
  const PrecisionScope digits(50);
  const auto from = [](const std::string& position, const std::string& velocity = "[0, 0]") {
    return pendulum(position, velocity, "1");
  };
  const std::string rounded =
      from("[0.5403023058681398, 0.8414709848078965]", "[-0.8414709848078965, 0.5403023058681398]");
  EXPECT_EQ(assembled<double>(rounded).settled, "");
  const auto scene = assembled<Mpfr>(rounded);
  expect_words(scene.settled, {"its own 16 digits", "moved by up to", "e-17"});
  EXPECT_EQ(scene.settled.find('\n'), std::string::npos);
  const Vector<Mpfr>&q = scene.q0, &p = scene.p0;
  EXPECT_LE(magnitude(Mpfr(q[0] * q[0] + q[1] * q[1] - 1)), 4 * epsilon<Mpfr>());
  EXPECT_LE(magnitude(Mpfr(q[0] * p[0] + q[1] * p[1])), 4 * epsilon<Mpfr>());
  // The nearest point is on the ray.
  const Mpfr x = literal<Mpfr>("0.5403023058681398"), y = literal<Mpfr>("0.8414709848078965");
  EXPECT_LE(magnitude(Mpfr(q[0] * y - q[1] * x)), 4 * epsilon<Mpfr>());
  // Few digits are meant as they stand, and so is a difference that rounding does not explain.
  expect_words(inconsistency<Mpfr>(from("[0.5403, 0.84147]")),
               {"position", "tolerance", "hbvm scene project --precision mpfr:50"});
  expect_words(inconsistency<Mpfr>(from("[0.5403023058681398, 0.8414709849078965]")),
               {"position", "hbvm scene project --precision mpfr:50"});
  expect_words(inconsistency<Mpfr>(from("[0.5403023058681398, 0.8414709848078965]", "[1, 0]")), {"velocity"});
  EXPECT_EQ(assembled<Mpfr>(from("[\"cos(1)\", \"sin(1)\"]")).settled, "");
}

/// Redundant constraints are found before their rounding makes them look apart.
TEST(Assemble, SettlesAStartWithRedundantConstraints) {
  // A square with both diagonals is one rod stiffer than it need be.
  const std::string text = R"(dimension = 2
body = [{ name = "a", mass = 1, position = [0, 0], velocity = [0, 0] },
        { name = "b", mass = 2, position = [0.5403023058681398, 0.8414709848078965], velocity = [0, 0] },
        { name = "c", mass = 3, position = [-0.3011686789397567, 1.3817732906760363], velocity = [0, 0] },
        { name = "d", mass = 4, position = [-0.8414709848078965, 0.5403023058681398], velocity = [0, 0] }]
)" + rod("a", "b", "1") + rod("b", "c", "1") +
                           rod("c", "d", "1") + rod("d", "a", "1") + rod("a", "c", "\"sqrt(2)\"") +
                           rod("b", "d", "\"sqrt(2)\"");
  for (const unsigned digits : {24U, 30U, 35U, 50U, 100U}) {
    const PrecisionScope scope(digits);
    const auto scene = assembled<Mpfr>(text);
    EXPECT_EQ(scene.problem.nu(), 5) << digits;
    EXPECT_EQ(scene.problem.redundant.size(), 1u) << digits;
    EXPECT_NE(scene.settled, "") << digits;
  }
}

/// What is dense in the constraints that share a body only would not end.
TEST(Assemble, StartsThousandsOfRods) {
  constexpr int n = 3'000;
  const auto scene = assembled<double>(chain(n, "4/5"));
  EXPECT_EQ(scene.problem.nu(), n);
  StateEvaluator<double> point(scene.problem);
  EXPECT_EQ(max_norm(point.hidden_constraints(scene.q0, scene.p0)), 0);
  EXPECT_EQ(max_norm(point.multiplier(scene.q0, scene.p0)), 0);
}

/// The parts of a joint are named together.
TEST(Assemble, NamesRedundantConstraintsByJoint) {
  const std::string text = joined_bodies.substr(0, joined_bodies.find("[[effect]]")) +
                           "[[constraint]]\nkind = \"hinge\"\nbetween = [{ of = \"base\", at = [1, 0, 0] }, { of = "
                           "\"arm\", at = [0, \"-1/2\", 0] }]\naxis = [0, 0, 2]\nsecond_axis = [-3, 0, 0]\n";
  const auto scene = assembled<double>(text);
  EXPECT_EQ(scene.problem.redundant.size(), 5u);
  std::size_t hinges = 0, length = 0;
  for (const Redundancy& redundancy : scene.redundant) {
    const std::string line = to_text(redundancy);
    hinges += line.find("hinge 'base[1, 0, 0]'-'arm[0, -1/2, 0]'") != std::string::npos;
    length = std::max(length, line.size());
  }
  EXPECT_LE(scene.redundant.size(), 2u);
  EXPECT_EQ(hinges, scene.redundant.size());
  EXPECT_LT(length, 400u);
}

TEST(Assemble, AsksForWorkingDigits) {
  EXPECT_THROW(assemble<Mpfr>(load_scene("kepler")), InputError);
  const PrecisionScope digits(30);
  EXPECT_NO_THROW(assemble<Mpfr>(load_scene("kepler")));
}

/// Two walls at an angle of 1e-10: in double no digit of the multipliers is left.
TEST(Assemble, RefusesASingularGramMatrix) {
  const PrecisionScope digits(50);
  const std::string text = R"(dimension = 2
body = [{ name = "a", mass = 1, position = [0, 0], velocity = [0, 0] }]
constraint = [{ kind = "plane", body = "a", normal = [0, 1], offset = 0 },
              { kind = "plane", body = "a", normal = ["1e-10", 1], offset = 0 }]
)";
  expect_words(inconsistency<double>(text), {"constraint 2 (plane of 'a')", "constraint 1", "1.00e-10", "more digits"});
  EXPECT_EQ(inconsistency<Quad>(text), "");
  EXPECT_EQ(inconsistency<Mpfr>(text), "");
}

/// The scene of joined bodies against its formulas, in coordinates on no symmetry of it.
class JoinedBodies : public InDigits<50> {
 protected:
  /// The point r + at.(d1, d2, d3) of the body whose reference point is at `offset`.
  Vector<Mpfr> point(Index offset, const std::vector<const char*>& at) const {
    Vector<Mpfr> x = q.segment(offset, 3);
    for (std::size_t a = 0; a < 3; ++a)
      x += q.segment(offset + 3 * (static_cast<Index>(a) + 1), 3) * literal<Mpfr>(at[a]);
    return x;
  }
  Vector<Mpfr> director(Index offset, Index a) const { return q.segment(offset + 3 * a, 3); }
  static Mpfr length(const Vector<Mpfr>& x) { return Mpfr(sqrt(Mpfr(x.dot(x)))); }

  Assembled<Mpfr> scene = assembled<Mpfr>(joined_bodies);
  const Vector<Mpfr> q = generic<Mpfr>(scene.problem.m(), 5);
  static constexpr Index bead = 0, base = 3, arm = 15, bob = 27;  // offsets of the coordinates
  const Vector<Mpfr> hook{{Mpfr(3), Mpfr(3), Mpfr(-1)}};
};

TEST_F(JoinedBodies, ConstraintsSayWhichPartTheyAre) {
  ASSERT_EQ(scene.problem.m(), 3 + 3 * 12);
  ASSERT_EQ(scene.problem.nu(), 18 + 5 + 3 + 1 + 1);
  std::vector<std::string> names;
  for (const char* const part : {"point, x", "point, y", "point, z", "axis, 1", "axis, 2"})
    names.push_back("hinge 'base[1, 0, 0]'-'arm[0, -1/2, 0]' (" + std::string(part) + ")");
  for (const char* const part : {"point, x", "point, y", "point, z"})
    names.push_back("ball_joint 'arm[0, 1/2, 0]'-'bob[0, 0, 0]' (" + std::string(part) + ")");
  names.emplace_back("rod 'left'-'hook'");
  for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(scene.problem.constraints[18 + i].name, names[i]);
}

TEST_F(JoinedBodies, ConstraintsAreThoseOfTheirPoints) {
  const Vector<Mpfr> g = StateEvaluator<Mpfr>(scene.problem).constraints(q);
  const Vector<Mpfr> hinge = point(base, {"1", "0", "0"}) - point(arm, {"0", "-1/2", "0"});
  const Vector<Mpfr> ball = point(arm, {"0", "1/2", "0"}) - point(bob, {"0", "0", "0"});
  for (Index i = 0; i < 3; ++i) {
    expect_near(g[18 + i], hinge[i], 10, "hinge");
    expect_near(g[23 + i], ball[i], 10, "ball joint");
  }
  // The hinge's axes are d3 of the base and -d1 of the arm, whose other directors are across it.
  expect_near(magnitude(g[21]), magnitude(Mpfr(director(base, 3).dot(director(arm, 2)))), 10, "axis");
  expect_near(magnitude(g[22]), magnitude(Mpfr(director(base, 3).dot(director(arm, 3)))), 10, "axis");
  const Vector<Mpfr> rod = point(bob, {"3", "0", "0"}) - hook;
  expect_near(g[26], Mpfr(rod.dot(rod) - 6), 1'000, "rod");
  expect_near(g[27], Mpfr(director(arm, 1).dot(Vector<Mpfr>(2 * director(bob, 1) - director(bob, 3)))), 100, "angle");
}

TEST_F(JoinedBodies, EffectsActOnTheirPoints) {
  const Vector<Mpfr> left = point(bob, {"3", "0", "0"}), right = point(bob, {"0", "-1", "1/4"}),
                     at = q.segment(bead, 3);
  const Mpfr half = Mpfr(1) / 2;
  const auto height = [&](const Vector<Mpfr>& x) { return Mpfr(x[1] / 2 - x[2]); };
  Mpfr V = -height(point(arm, {"0", "0", "0"})) - 3 * height(point(bob, {"1/10", "1/5", "0"}));
  // All charged pairs but those of one body.
  const auto coulomb = [&](const Vector<Mpfr>& x, const Vector<Mpfr>& y, const Mpfr& product) {
    V += literal<Mpfr>("0.7") * product / length(Vector<Mpfr>(x - y));
  };
  coulomb(at, left, 3 * half);
  coulomb(at, right, -3);
  coulomb(at, hook, 6);
  coulomb(left, hook, 1);
  coulomb(right, hook, -2);
  for (const Vector<Mpfr>& x : {Vector<Mpfr>(at - right), Vector<Mpfr>(point(base, {"0", "2", "0"}) - left)}) {
    const Mpfr stretch = length(x) - half;
    V += stretch * stretch;
  }
  for (const Vector<Mpfr>& x : {Vector<Mpfr>(at - hook), Vector<Mpfr>(point(arm, {"1/3", "0", "1"}) - hook)})
    V += 3 * half * x.dot(x);
  expect_near(StateEvaluator<Mpfr>(scene.problem).energy(q, Vector<Mpfr>::Zero(q.size())), V, 1'000,
              "potential energy");
}

TEST_F(JoinedBodies, ForcesAreDerivatives) { expect_forces_are_derivatives(scene.problem, q); }

std::string conserved_in(const std::string& text) { return conserved(assembled<double>(text).problem); }

/// The scene without what acts on it, and without the rod to the hook.
std::string free_chain() {
  return changed(joined_bodies.substr(0, joined_bodies.find("[[effect]]")), rod("left", "hook", "\"sqrt(6)\""), "");
}

/// Joints keep all momenta, though a rotation mixes the components of a common point.
TEST(JoinedMomenta, OfAFreeChainAreAllConserved) {
  EXPECT_EQ(conserved_in(free_chain()), "P_x, P_y, P_z, L_x, L_y, L_z");
  EXPECT_EQ(assembled<double>(free_chain()).problem.nu(), 27);
}

TEST(JoinedMomenta, OfAChainThatHangsAreThoseAboutTheNail) {
  const std::string joint =
      "[[constraint]]\nkind = \"ball_joint\"\nbetween = [\"nail\", { of = \"base\", at = [0, 0, 0] }]\n";
  const std::string nail = "[[point]]\nname = \"nail\"\nposition = [0, 0, 0]\n";
  std::string text = changed(free_chain(), "[[body]]", nail + "[[body]]") + joint;
  for (const auto& [from, to] : {std::pair("velocity = [1, 0, 0]", "velocity = [0, 0, 0]"),
                                 std::pair("velocity = [1, \"5/2\", 0]", "velocity = [0, \"5/2\", 0]"),
                                 std::pair("velocity = [1, 4, 0]", "velocity = [0, 4, 0]")})
    text = changed(text, from, to);
  EXPECT_EQ(conserved_in(text), "L_x, L_y, L_z");
  const std::string gravity = "[[effect]]\nkind = \"uniform_gravity\"\nacceleration = [0, -1, 0]\n";
  EXPECT_EQ(conserved_in(text + gravity), "L_y");
  // A hinge in space leaves the rotations about its axis; the base turns about z.
  const std::string hinge = changed(joint, "\"ball_joint\"", "\"hinge\"\naxis = [0, 0, 1]");
  EXPECT_EQ(conserved_in(changed(text, joint, hinge)), "L_z");
  EXPECT_EQ(conserved_in(changed(text, joint, hinge) + gravity), "");
}

/// A body on a fixed point needs no second one there, but a hinge must be at that point.
TEST(Hinge, OfABodyWithAFixedPointIsItsAxis) {
  const auto top = [](const char* post, const char* at) {
    return std::string("dimension = 3\n[[point]]\nname = \"post\"\nposition = ") + post +
           "\n[[rigid_body]]\nname = \"top\"\nfixed_at = [\"1/3\", \"1/7\", \"sqrt(2)\"]\nmass = 1\ncenter = [0, 0, "
           "1]\n"
           "second_moment = [[1, 0, 0], [0, 1, 0], [0, 0, 2]]\ndirectors = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\n"
           "angular_velocity = [0, 0, 3]\n"
           "[[constraint]]\nkind = \"hinge\"\nbetween = [\"post\", { of = \"top\", at = " +
           at + " }]\naxis = [0, 0, 1]\n";
  };
  const PrecisionScope digits(50);
  const std::string written_otherwise = "[\"2/6\", \"1 - 6/7\", \"2/sqrt(2)\"]";
  EXPECT_EQ(assembled<double>(top(written_otherwise.c_str(), "[0, 0, 0]")).problem.nu(), 8);
  EXPECT_EQ(assembled<Mpfr>(top(written_otherwise.c_str(), "[0, 0, 0]")).problem.nu(), 8);
  expect_words(inconsistency<double>(top("[0, 0, 0]", "[0, 0, 0]")),
               {"test.toml:", "hinge", "fixed in space", "apart"});
  // At another point of its axis, above the fixed one, three of the common point follow from the body's own.
  const auto above = assembled<Mpfr>(top("[\"1/3\", \"1/7\", \"sqrt(2) + 2\"]", "[0, 0, 2]"));
  EXPECT_EQ(above.problem.nu(), 8);
  EXPECT_EQ(above.problem.redundant.size(), 3u);
}

/// A door that turns, whose hinge follows from its fixed point in part. The axis stands still but for rounding, which
/// is that of the velocities of the whole door.
TEST(Hinge, OfADoorThatTurnsIsNoContradiction) {
  const PrecisionScope digits(50);
  for (const char* const spin : {"2", "\"1/3\"", "1000000"}) {
    const std::string text = std::string(R"(dimension = 3
[[point]]
name = "upper"
position = [0, 0, 2]
[[rigid_body]]
name = "door"
fixed_at = [0, 0, 0]
mass = 3
center = ["1/2", 0, 1]
inertia = ["1/2", "1/2", "1/4"]
orientation = { axis = [0, 0, 1], angle = "1/3" }
angular_velocity = [0, 0, )") +
                             spin + R"(]
[[constraint]]
kind = "hinge"
between = ["upper", { of = "door", at = [0, 0, 2] }]
axis = [0, 0, 1]
)";
    EXPECT_EQ(inconsistency<double>(text), "");
    EXPECT_EQ(inconsistency<Quad>(text), "");
    EXPECT_EQ(assembled<Mpfr>(text).problem.redundant.size(), 3u);
  }
}

/// Planes and quadrics of points of rigid bodies, by name and in place, against the same as formulas.
TEST(PointsOfRigidBodies, LieOnPlanesAndQuadrics) {
  const PrecisionScope digits(50);
  const auto unchecked = [](const std::string& constraints) {
    return assembled<Mpfr>(joined_bodies + constraints, Consistency::unchecked);
  };
  const auto built_in = unchecked(
      "[[constraint]]\nkind = \"plane\"\nbody = \"left\"\nnormal = [1, \"1/3\", -2]\noffset = \"1/7\"\n"
      "[[constraint]]\nkind = \"quadric\"\nbody = { of = \"bob\", at = [1, 0, -2] }\n"
      "A = [[1, 2, 0], [2, \"1/3\", 0], [0, 0, -1]]\nb = [1, 0, 5]\nc = -4\n"
      "[[constraint]]\nkind = \"quadric\"\nbody = \"right\"\nA = [[0, 0, 0], [0, 0, 0], [0, 0, 0]]\nb = [1, 2, 3]\n"
      "c = 5\n");
  const auto formulas = unchecked(
      "[[constraint]]\nkind = \"formula\"\non = \"left\"\ng = \"x + y/3 - 2*z - 1/7\"\n"
      "[[constraint]]\nkind = \"formula\"\non = { of = \"bob\", at = [1, 0, -2] }\n"
      "g = \"x^2 + 4*x*y + y^2/3 - z^2 + x + 5*z - 4\"\n"
      "[[constraint]]\nkind = \"formula\"\non = \"right\"\ng = \"x + 2*y + 3*z + 5\"\n");
  const Vector<Mpfr> q = generic<Mpfr>(built_in.problem.m(), 3), p = generic<Mpfr>(built_in.problem.m(), 4);
  StateEvaluator<Mpfr> one(built_in.problem), other(formulas.problem);
  const Vector<Mpfr> g = one.constraints(q), hidden = one.hidden_constraints(q, p), lambda = one.multiplier(q, p);
  const Vector<Mpfr> g2 = other.constraints(q), hidden2 = other.hidden_constraints(q, p),
                     lambda2 = other.multiplier(q, p);
  ASSERT_EQ(g.size(), 31);
  for (Index i = 28; i < 31; ++i) {
    expect_near(g[i], g2[i], 1'000, "g");
    expect_near(hidden[i], hidden2[i], 1'000, "hidden");
    expect_near(lambda[i], lambda2[i], 1'000'000, "multiplier");
  }
  EXPECT_TRUE(std::holds_alternative<Plane<Mpfr>>(built_in.problem.constraints[28].form));
  EXPECT_TRUE(std::holds_alternative<Plane<Mpfr>>(built_in.problem.constraints[30].form));
  EXPECT_EQ(built_in.problem.constraints[28].name, "plane of 'left'");
}

/// A plate that turns about a point of the plane, and a nail.
const std::string plate_and_nail = R"(dimension = 2
[[point]]
name = "nail"
position = [0, 1]
[[rigid_body]]
name = "plate"
fixed_at = ["1/3", 2]
mass = 1
center = [0, 1]
second_moment = [[1, 0], [0, 2]]
directors = [[1, 0], [0, 1]]
angular_velocity = 0
)";

/// A point of a fixed body is fixed in part: the quadric has the fixed point's share in its coefficients.
TEST(PointsOfRigidBodies, OfAFixedBodyLieOnAQuadric) {
  const PrecisionScope digits(50);
  const std::string scene =
      plate_and_nail + "[[constraint]]\nkind = \"quadric\"\nbody = { of = \"plate\", at = [2, \"1/2\"] }\n";
  const std::string curve = "A = [[1, \"1/2\"], [\"1/2\", 3]]\nb = [1, -2]\nc = ";
  // At (7/3, 5/2): 49/9 + 35/6 + 75/4 + 7/3 - 5 = 985/36.
  const auto there = assembled<Mpfr>(scene + curve + "\"-985/36\"\n");
  EXPECT_EQ(there.problem.nu(), 4);
  expect_words(inconsistency<Mpfr>(scene + curve + "-27\n"), {"quadric of 'plate[2, 1/2]'", "3.61e-01"});
  expect_words(inconsistency<Mpfr>(changed(scene + curve + "0\n", "at = [2, \"1/2\"]", "at = [0, 0]")),
               {"quadric", "fixed in space"});
}

/// What slides on a plane keeps the momenta along it.
TEST(PointsOfRigidBodies, OnAPlaneKeepItsSymmetry) {
  std::string text = free_chain() +
                     "[[constraint]]\nkind = \"plane\"\nbody = { of = \"base\", at = [\"1/3\", 0, 0] }\n"
                     "normal = [0, 0, 2]\noffset = 0\n";
  EXPECT_EQ(conserved_in(text), "P_x, P_y, L_z");
}

TEST(Hinge, OfAMassPointIsRefused) {
  const std::string text = changed(joined_bodies, "{ of = \"base\", at = [1, 0, 0] }", "\"bead\"");
  expect_words(inconsistency<double>(text),
               {"test.toml:" + std::to_string(line_of(text, "kind = \"hinge\"") - 1), "hinge", "no directions"});
}

TEST(Rod, OfPointsThatAreBothFixedIsRefused) {
  const std::string pair = "between = [\"nail\", { of = \"plate\", at = [0, 0] }]\n";
  for (const auto& [table, kind, keys] : {std::array{"[[constraint]]", "rod", "length = 1\n"},
                                          {"[[constraint]]", "ball_joint", ""},
                                          {"[[effect]]", "spring", "stiffness = 1\n"}})
    expect_words(inconsistency<double>(plate_and_nail + table + "\nkind = \"" + kind + "\"\n" + pair + keys),
                 {"test.toml:13: ", kind, "fixed in space"});
}

/// Bars whose hinges have one direction move in a plane, whatever the hinges say of it. A loop of four has three
/// constraints more than it needs.
TEST(Assemble, SetsAsideThreeOfALoopOfParallelHinges) {
  const auto bar = [](const std::string& name, const std::string& position, const std::string& d1,
                      const std::string& d2) {
    return "[[rigid_body]]\nname = \"" + name + "\"\nposition = " + position +
           "\nvelocity = [0, 0, 0]\nmass = 1\ncenter = [0, 0, 0]\n"
           "second_moment = [[\"1/3\", 0, 0], [0, \"1/30\", 0], [0, 0, \"1/20\"]]\ndirectors = [" +
           d1 + ", " + d2 + ", [0, 0, 1]]\nangular_velocity = [0, 0, 0]\n";
  };
  const auto hinge = [](const std::string& a, const std::string& b) {
    return "[[constraint]]\nkind = \"hinge\"\nbetween = [" + a + ", " + b + "]\naxis = [0, 0, 1]\n";
  };
  const auto end = [](const std::string& name, const std::string& x) {
    return "{ of = \"" + name + "\", at = [\"" + x + "\", 0, 0] }";
  };
  const std::string text =
      "dimension = 3\n[[point]]\nname = \"A\"\nposition = [0, 0, 0]\n[[point]]\nname = \"B\"\nposition = [2.3, 0, "
      "0]\n" +
      bar("crank", "[-0.8, 0.6, 0]", "[-0.8, 0.6, 0]", "[-0.6, -0.8, 0]") +
      bar("coupler", "[-0.8, 0.6, 0]", "[0.8, 0.6, 0]", "[-0.6, 0.8, 0]") +
      bar("rocker", "[2.3, 0, 0]", "[-0.28, 0.96, 0]", "[-0.96, -0.28, 0]") + hinge("\"A\"", end("crank", "-1")) +
      hinge(end("crank", "0"), end("coupler", "0")) + hinge(end("coupler", "3"), end("rocker", "5/2")) +
      hinge(end("rocker", "0"), "\"B\"");
  const auto scene = assembled<Quad>(text);
  EXPECT_EQ(scene.problem.m(), 36);
  EXPECT_EQ(scene.problem.nu(), 35);
  EXPECT_EQ(scene.problem.redundant.size(), 3u);
}

/// Six g for a weld, five for a slider, four for the others: eleven degrees of freedom, which keep all momenta.
TEST(Mechanism, LeavesWhatItsJointsLeave) {
  const auto scene = assembled<Quad>(mechanism);
  EXPECT_EQ(scene.problem.m(), 60);
  EXPECT_EQ(scene.problem.nu(), 30 + 19);
  EXPECT_TRUE(scene.problem.redundant.empty());
  EXPECT_EQ(conserved(scene.problem), "P_x, P_y, P_z, L_x, L_y, L_z");
  std::vector<std::string> names;
  for (const char* const part : {"across, 1", "across, 2", "turn, 1", "turn, 2", "turn, 3"})
    names.push_back("prismatic 'base[0, 0, 0]'-'slider[0, 0, 0]' (" + std::string(part) + ")");
  for (const char* const part : {"point, x", "point, y", "point, z", "turn, 1", "turn, 2", "turn, 3"})
    names.push_back("weld 'corner'-'plate[0, 0, 0]' (" + std::string(part) + ")");
  for (const char* const part : {"point, x", "point, y", "point, z", "axes"})
    names.push_back("universal 'plate[0, 0, 1]'-'fork[0, 0, 0]' (" + std::string(part) + ")");
  for (const char* const part : {"across, 1", "across, 2", "axis, 1", "axis, 2"})
    names.push_back("cylindrical 'fork[0, 0, 1]'-'shaft[0, 0, 0]' (" + std::string(part) + ")");
  for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(scene.problem.constraints[30 + i].name, names[i]);
}

/// Directors that are parallel at the start, askew in space, are so to the last digit: no weight is what rounding left.
TEST(Mechanism, HasNoWeightsOfRoundOff) {
  const auto scene = assembled<double>(changed(mechanism, "{ directors = [[0, 1, 0], [-1, 0, 0], [0, 0, 1]] }",
                                               "{ axis = [1, 2, 2], angle = \"pi/3\" }"),
                                       Consistency::unchecked);
  for (const auto& constraint : scene.problem.constraints) {
    const auto* const product = std::get_if<DisplacementProduct<double>>(&constraint.form);
    if (!product) continue;
    for (const auto* const x : {&product->x, &product->y})
      for (const auto& block : x->blocks) EXPECT_GE(magnitude(block.weight), 1 / double{1'000}) << constraint.name;
  }
}

/// A second weld of two bodies, and one that closes a loop, say nothing new; each is named once.
TEST(Mechanism, SetsAsideWhatASecondWeldSays) {
  const std::string again =
      "[[constraint]]\nkind = \"weld\"\nbetween = [{ of = \"plate\", at = [0, 0, 1] }, { of = \"fork\", at = [0, 0, 0] "
      "}]\n"
      "[[constraint]]\nkind = \"weld\"\nbetween = [{ of = \"fork\", at = [0, 0, -1] }, \"corner\"]\n";
  const PrecisionScope digits(50);
  const auto scene = assembled<Mpfr>(mechanism + again);
  EXPECT_EQ(scene.problem.m() - scene.problem.nu(), 9);
  EXPECT_EQ(scene.problem.redundant.size(), 10u);
  std::size_t welds = 0;
  for (const Redundancy& redundancy : scene.redundant)
    welds += redundancy.name.find("(weld 'fork[0, 0, -1]'-'corner')") != std::string::npos;
  EXPECT_EQ(welds, 1u);
  EXPECT_LE(scene.redundant.size(), 4u);
}

TEST(Mechanism, OfJointsThatHoldNothingIsRefused) {
  const auto wrong = [](const std::string& from, const std::string& to) {
    return inconsistency<double>(changed(mechanism, from, to));
  };
  const auto line = [](const std::string& kind) {
    return "test.toml:" + std::to_string(line_of(mechanism, "kind = \"" + kind + "\"") - 1) + ": ";
  };
  expect_words(wrong("axis = [3, 0, 0]", "axis = [0, 0, 0]"), {line("prismatic"), "'axis' is 0"});
  expect_words(wrong("second_axis = [0, 0, -2]", "second_axis = [0, 0, 0]"),
               {line("cylindrical"), "'second_axis' is 0"});
  expect_words(wrong("axis = [0, 0, 1]\nsecond_axis = [0, 0, -2]", "axis = [0, 1, 1]\nsecond_axis = [0, 0, -2]"),
               {line("cylindrical"), "position", "(axis, "});
  expect_words(wrong("second_axis = [0, 1, 0]", "second_axis = [-1, 0, 0]"),
               {line("universal"), "parallel at the start"});
  expect_words(wrong("second_axis = [0, 1, 0]", "second_axis = [-1, 3, 0]"), {line("universal"), "position", "(axes)"});
  expect_words(wrong("position = [2, 1, 4]", "position = [2, 2, 4]"), {line("cylindrical"), "position", "(across, "});
  // The bodies must move together at the start.
  expect_words(wrong("velocity = [1, 0, \"1/2\"]", "velocity = [1, 1, \"1/2\"]"), {line("cylindrical"), "velocity"});
  expect_words(wrong("angular_velocity = [0, 0, 3]", "angular_velocity = [1, 0, 3]"),
               {line("cylindrical"), "velocity"});
  // Both points fixed in space.
  const auto fixed = [&](const std::string& kind, const std::string& keys) {
    return inconsistency<double>(
        changed(mechanism, "position = [0, 0, 0]\nvelocity = [0, 0, 0]", "fixed_at = [0, 0, 0]") +
        "[[constraint]]\nkind = \"" + kind + "\"\nbetween = [\"post\", { of = \"base\", at = [0, 0, 0] }]\n" + keys);
  };
  EXPECT_EQ(fixed("weld", ""), "");
  expect_words(fixed("prismatic", "axis = [1, 0, 0]\n"), {"prismatic", "fixed in space, where nothing slides"});
  expect_words(fixed("cylindrical", "axis = [1, 0, 0]\n"), {"cylindrical", "fixed in space, where nothing slides"});
  const std::string bead = "[[body]]\nname = \"bead\"\nmass = 1\nposition = [0, 0, 0]\nvelocity = [0, 0, 0]\n";
  for (const char* const kind : {"weld", "prismatic"})
    expect_words(inconsistency<double>(mechanism + bead + "[[constraint]]\nkind = \"" + kind +
                                       "\"\nbetween = [{ of = \"base\", at = [0, 0, 0] }, \"bead\"]\n" +
                                       (kind == std::string("weld") ? "" : "axis = [1, 0, 0]\n")),
                 {kind, "no directions"});
}

/// Two wheels of the plane, with a gear.
std::string geared(const std::string& keys) {
  std::string text = "dimension = 2\n[[point]]\nname = \"o\"\nposition = [0, 0]\n";
  for (const char* const name : {"one", "two"})
    text += std::string("[[rigid_body]]\nname = \"") + name +
            "\"\nfixed_at = [0, 0]\nmass = 1\ncenter = [0, 0]\ninertia = 1\norientation = 1\nangular_velocity = " +
            (name == std::string("one") ? "3" : "-2") + "\n";
  return text +
         "[[constraint]]\nkind = \"gear\"\nbetween = [{ of = \"one\", at = [1, 0] }, { of = \"two\", at = [0, 0] }]\n" +
         keys;
}

TEST(Gear, OfWrongTeethIsRefused) {
  const auto refusal = [](const std::string& first, const std::string& second, const std::string& more = "") {
    return inconsistency<double>(geared("first_teeth = " + first + "\nsecond_teeth = " + second + "\n" + more));
  };
  EXPECT_EQ(refusal("20", "30"), "");
  EXPECT_EQ(refusal("\"2*10\"", "30"), "");
  EXPECT_EQ(refusal("-20", "-30"), "");
  expect_words(refusal("20", "-30"), {"test.toml:21: ", "velocity", "gear 'one[1, 0]'-'two[0, 0]'"});
  expect_words(refusal("20", "31"), {"velocity"});
  expect_words(refusal("0", "30"), {"test.toml:21: ", "(gear)", "'first_teeth' must be a whole number"});
  expect_words(refusal("20", "2.5"), {"'second_teeth' must be a whole number"});
  expect_words(refusal("\"1e300\"", "2"), {"'first_teeth' must be a whole number"});
  expect_words(refusal("61", "47"), {"61 and 47", "beyond 100", "simpler ratio"});
  expect_words(refusal("20", "30", "axis = [1, 0]\n"), {"in the plane wheels need no axis"});
  expect_words(inconsistency<double>(
                   changed(geared("first_teeth = 2\nsecond_teeth = 3\n"), "{ of = \"two\", at = [0, 0] }", "\"o\"")),
               {"a gear is of points of two rigid bodies"});
}

/// Turning space turns both wheels, and changes what the teeth compare.
TEST(Gear, KeepsNoAngularMomentum) {
  const std::string text = geared("first_teeth = 2\nsecond_teeth = 3\n");
  EXPECT_EQ(conserved(assembled<double>(text.substr(0, text.find("[[constraint]]"))).problem), "L_z");
  EXPECT_EQ(conserved(assembled<double>(text).problem), "");
}

}  // namespace
}  // namespace hbvm::core

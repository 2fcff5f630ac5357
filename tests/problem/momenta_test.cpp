#include "problem/momenta.hpp"

#include <Eigen/SVD>

#include "printing.hpp"
#include "problem/any_constraint.hpp"
#include "problem/effect/input.hpp"
#include "scalar/literal.hpp"
#include "scalar/random_values.hpp"
#include "scalar/text.hpp"
#include "scene/assemble.hpp"
#include "scene/scene_text.hpp"

namespace hbvm::core {
namespace {

template <class S>
class Momenta : public InDigits<50> {
 protected:
  static Vector<S> vector(std::initializer_list<int> entries) {
    Vector<S> v(static_cast<Index>(entries.size()));
    Index i = 0;
    for (const int entry : entries) v[i++] = S(entry);
    return v;
  }

  static std::vector<S> along_axes(const Problem<S>& problem, const Vector<S>& q, const Vector<S>& p) {
    std::vector<S> values;
    for (const auto& component : coordinate_momenta(problem))
      values.push_back(momentum(problem, component, q, p).value);
    return values;
  }

  static std::string names(const std::vector<MomentumComponent<S>>& components) {
    std::string text;
    for (const auto& component : components) text += (text.empty() ? "" : ", ") + component.name();
    return text;
  }
  static std::string conserved(const Scene& text) {
    const auto scene = assemble<S>(text);
    return names(conserved_momenta(scene.problem));
  }
  static std::string conserved(const std::string& text) { return conserved(read_scene(text, "test.toml")); }
};
TYPED_TEST_SUITE(Momenta, AllScalars, ScalarNames);

TYPED_TEST(Momenta, OfTwoBodiesInThePlane) {
  const auto problem = free_bodies<TypeParam>(2, {1, 2});
  const auto P_and_L = this->along_axes(problem, this->vector({1, 2, 3, 5}), this->vector({7, 11, 13, 17}));
  EXPECT_EQ(P_and_L, (std::vector<TypeParam>{7 + 13, 11 + 17, (1 * 11 - 2 * 7) + (3 * 17 - 5 * 13)}));
}

TYPED_TEST(Momenta, OfABodyInSpaceIsTheCrossProduct) {
  const auto problem = free_bodies<TypeParam>(3, {1});
  const auto P_and_L = this->along_axes(problem, this->vector({1, 2, 3}), this->vector({4, 5, 7}));
  EXPECT_EQ(P_and_L, (std::vector<TypeParam>{4, 5, 7, 2 * 7 - 3 * 5, 3 * 4 - 1 * 7, 1 * 5 - 2 * 4}));
}

TYPED_TEST(Momenta, AboutAnyAxisIsTheSumOfThoseAlongTheCoordinateAxes) {
  const auto problem = free_bodies<TypeParam>(3, {1});
  const MomentumComponent<TypeParam> sum{this->vector({2, 2, 2}), this->vector({-1, -1, -1})};
  EXPECT_EQ(sum.name(), "2 L_x + 2 L_y + 2 L_z - P_x - P_y - P_z");
  EXPECT_EQ(momentum(problem, sum, this->vector({1, 2, 3}), this->vector({4, 5, 7})).value,
            2 * ((2 * 7 - 3 * 5) + (3 * 4 - 1 * 7) + (1 * 5 - 2 * 4)) - (4 + 5 + 7));
}

TYPED_TEST(Momenta, AreNamedByAxis) {
  EXPECT_EQ(this->names(coordinate_momenta(free_bodies<TypeParam>(2, {1}))), "P_x, P_y, L_z");
  EXPECT_EQ(this->names(coordinate_momenta(free_bodies<TypeParam>(3, {1}))), "P_x, P_y, P_z, L_x, L_y, L_z");
}

TYPED_TEST(Momenta, OfAFixedRigidBodyIsAngularOnly) {
  const auto scene = assemble<TypeParam>(load_scene("heavy_top"));
  EXPECT_EQ(this->names(coordinate_momenta(scene.problem)), "L_x, L_y, L_z");
}

/// The same body as four points of mass 1, 2, 3 and 4 of a turned, moving body frame.
TYPED_TEST(Momenta, OfARigidBodyAreThoseOfThePointsItConsistsOf) {
  using S = TypeParam;
  const int mass[4] = {1, 2, 3, 4}, X[4][3] = {{1, 0, 0}, {0, 1, 1}, {-1, 1, 0}, {0, -1, 2}};
  // 10 c = sum m X, J = sum m X X^T
  const std::string text = R"(dimension = 3
[[rigid_body]]
name = "body"
position = [1, -2, 3]
velocity = ["1/2", 1, -1]
mass = 10
center = ["-1/5", "1/10", 1]
second_moment = [[4, -3, 0], [-3, 9, -6], [0, -6, 18]]
directors = [["2/3", "2/3", "1/3"], ["-2/3", "1/3", "2/3"], ["1/3", "-2/3", "2/3"]]
angular_velocity = [1, 2, -3]
)";
  const int d[3][3] = {{2, 2, 1}, {-2, 1, 2}, {1, -2, 2}}, r[3] = {1, -2, 3}, omega[3] = {1, 2, -3};
  const S v[3] = {S(1) / 2, S(1), S(-1)};
  Vector<S> P = Vector<S>::Zero(3), L = Vector<S>::Zero(3);
  for (int point = 0; point < 4; ++point) {
    S arm[3], x[3], p[3];
    for (int j = 0; j < 3; ++j) {
      int sum = 0;
      for (int a = 0; a < 3; ++a) sum += X[point][a] * d[a][j];
      arm[j] = S(sum) / 3;
      x[j] = r[j] + arm[j];
    }
    for (int j = 0; j < 3; ++j) {
      const int k = (j + 1) % 3, l = (j + 2) % 3;
      p[j] = mass[point] * (v[j] + omega[k] * arm[l] - omega[l] * arm[k]);
      P[j] += p[j];
    }
    for (int j = 0; j < 3; ++j) L[j] += x[(j + 1) % 3] * p[(j + 2) % 3] - x[(j + 2) % 3] * p[(j + 1) % 3];
  }
  const auto scene = assemble<S>(read_scene(text, "test.toml"));
  const auto P_and_L = this->along_axes(scene.problem, scene.q0, scene.p0);
  ASSERT_EQ(P_and_L.size(), 6u);
  for (int axis = 0; axis < 3; ++axis) {
    const S tolerance = 1'000 * epsilon<S>();
    EXPECT_LE(magnitude(S(P_and_L[axis] - P[axis])), tolerance) << axis;
    EXPECT_LE(magnitude(S(P_and_L[axis + 3] - L[axis])), tolerance) << axis;
  }
  EXPECT_EQ(this->conserved(text), "P_x, P_y, P_z, L_x, L_y, L_z");
}

const std::string plane_pair = R"(dimension = 2
point = [{ name = "O", position = [0, 0] }, { name = "A", position = [0, 3] }]
body = [{ name = "a", mass = 1, position = [1, 0], velocity = [0, 0] },
        { name = "b", mass = 2, position = [0, "1/2"], velocity = [0, 0] }]
)";
const std::string space_body = R"(dimension = 3
point = [{ name = "O", position = [0, 0, 0] }, { name = "A", position = [0, 0, 3] }]
body = [{ name = "a", mass = 1, position = ["2/3", "-1/3", "2/3"], velocity = [0, 0, 0] }]
)";

std::string effect(const std::string& kind, const std::string& keys) {
  return "[[effect]]\nkind = \"" + kind + "\"\n" + keys + "\n";
}
std::string constraint(const std::string& kind, const std::string& keys) {
  return "[[constraint]]\nkind = \"" + kind + "\"\n" + keys + "\n";
}

TYPED_TEST(Momenta, ConservedInThePlane) {
  const auto conserved = [&](const std::string& more = {}) { return this->conserved(plane_pair + more); };
  const std::string gravity = effect("uniform_gravity", "acceleration = [0, -1]"),
                    mutual = effect("mutual_gravity", "strength = 1"), trap = "stiffness = 1\nexponent = 2\ncenter = ";
  EXPECT_EQ(conserved(), "P_x, P_y, L_z");
  EXPECT_EQ(conserved(mutual), "P_x, P_y, L_z");
  EXPECT_EQ(conserved(gravity + mutual), "P_x");
  EXPECT_EQ(conserved(mutual + effect("trap", trap + "\"O\"")), "L_z");
  EXPECT_EQ(conserved(mutual + effect("trap", trap + "\"A\"")), "L_z + 3 P_x");
  EXPECT_EQ(conserved(effect("trap", trap + "\"O\"\non = [\"a\"]")), "L_z");
  EXPECT_EQ(conserved(constraint("rod", "between = [\"a\", \"b\"]\nlength = \"sqrt(5)/2\"")), "P_x, P_y, L_z");
  EXPECT_EQ(conserved(constraint("rod", "between = [\"a\", \"O\"]\nlength = 1")), "L_z");
  EXPECT_EQ(conserved(constraint("rod", "between = [\"b\", \"A\"]\nlength = 2.5")), "L_z + 3 P_x");
  EXPECT_EQ(conserved(constraint("plane", "body = \"a\"\nnormal = [0, 2]\noffset = 0")), "P_x");
  EXPECT_EQ(conserved(constraint("angle", "first = [\"a\", \"b\"]\nsecond = [\"b\", \"a\"]\nvalue = -1.25")),
            "P_x, P_y, L_z");
}

TYPED_TEST(Momenta, ConservedInSpace) {
  const auto conserved = [&](const std::string& more = {}) { return this->conserved(space_body + more); };
  const auto quadric = [](const std::string& A, const std::string& c) {
    return constraint("quadric", "body = \"a\"\nb = [0, 0, 0]\nA = " + A + "\nc = \"" + c + "\"");
  };
  const std::string gravity = effect("uniform_gravity", "acceleration = [0, 0, -1]"),
                    pull = "strength = 1\ncenter = ", sphere = quadric("[[1, 0, 0], [0, 1, 0], [0, 0, 1]]", "-1");
  EXPECT_EQ(conserved(), "P_x, P_y, P_z, L_x, L_y, L_z");
  EXPECT_EQ(conserved(gravity), "P_x, P_y, L_z");
  EXPECT_EQ(conserved(effect("central_gravity", pull + "\"O\"")), "L_x, L_y, L_z");
  EXPECT_EQ(conserved(effect("central_gravity", pull + "\"A\"")), "L_x + 3 P_y, L_y - 3 P_x, L_z");
  EXPECT_EQ(conserved(effect("central_gravity", pull + "\"A\"") + effect("radial_cosine", pull + "\"O\"")), "L_z");
  EXPECT_EQ(conserved(sphere), "L_x, L_y, L_z");
  EXPECT_EQ(conserved(sphere + gravity), "L_z");
  EXPECT_EQ(conserved(quadric("[[2, 0, 0], [0, 1, 0], [0, 0, 1]]", "-13/9")), "L_x");
  EXPECT_EQ(conserved(quadric("[[2, 0, 0], [0, 1, 0], [0, 0, 3]]", "-21/9")), "");
  EXPECT_EQ(conserved(quadric("[[1, 0, 0], [0, 1, 0], [0, 0, 0]]", "-5/9")), "P_z, L_z");
  EXPECT_EQ(conserved(effect("oblateness", pull + "\"O\"\nradius = 1\nJ2 = 1\naxis = [0, 1, 0]")), "L_y");
}

/// The kinetic energy must not change either: M of no symmetry moves freely, but does not turn freely.
TYPED_TEST(Momenta, ConservedWithAMassMatrix) {
  const auto body = [](const std::string& mass, const std::string& zeros) {
    return "dimension = " + std::string(zeros == "[0, 0]" ? "2" : "3") + "\nbody = [{ name = \"a\", mass = " + mass +
           ", position = " + zeros + ", velocity = " + zeros + " }]\n";
  };
  EXPECT_EQ(this->conserved(body("[[3, 0], [0, 3]]", "[0, 0]")), "P_x, P_y, L_z");
  EXPECT_EQ(this->conserved(body("[[3, 1], [1, 3]]", "[0, 0]")), "P_x, P_y");
  EXPECT_EQ(this->conserved(body("[[3, 0, 0], [0, 2, 0], [0, 0, 3]]", "[0, 0, 0]")), "P_x, P_y, P_z, L_y");
}

TYPED_TEST(Momenta, ConservedByRigidBodies) {
  const std::string top = R"(dimension = 3
[[rigid_body]]
name = "top"
fixed_at = [0, 0, 0]
mass = 1
center = [0, "1/4", 1]
second_moment = [[1, 0, 0], [0, 2, "1/3"], [0, "1/3", 3]]
directors = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
angular_velocity = [1, 2, 3]
)";
  EXPECT_EQ(this->conserved(top), "L_x, L_y, L_z");
  EXPECT_EQ(this->conserved(top + effect("uniform_gravity", "acceleration = [0, -2, 0]")), "L_y");
  EXPECT_EQ(this->conserved(top + effect("uniform_gravity", "acceleration = [0, -2, 1]")), "L_y - 0.5 L_z");
}

TYPED_TEST(Momenta, ConservedByScenesAboutCoordinateAxes) {
  EXPECT_EQ(this->conserved(load_scene("kepler")), "L_z");
  EXPECT_EQ(this->conserved(load_scene("heavy_top")), "L_z");
  EXPECT_EQ(this->conserved(load_scene("fekete_points")), "L_x, L_y, L_z");
  EXPECT_EQ(this->conserved(load_scene("free_rigid_body")), "P_x, P_y, P_z, L_x, L_y, L_z");
  EXPECT_EQ(this->conserved(load_scene("charged_tetrahedron")), "P_x, P_y, P_z, L_x, L_y, L_z");
  EXPECT_EQ(this->conserved(load_scene("bead_on_ellipsoid")), "");
}

TYPED_TEST(Momenta, ConservedByScenesAboutObliqueAxes) {
  EXPECT_EQ(this->conserved(load_scene("satellites_with_oblateness")), "L_x + 1.5 L_y + 3 L_z");
  EXPECT_EQ(this->conserved(load_scene("spring_and_plane")), "P_x - P_z, P_y - 0.5 P_z, L_x + 0.5 L_y + L_z");
}

/// (q - c) x p = L_z + c_y P_x - c_x P_y.
TYPED_TEST(Momenta, ConservedAboutAnotherPoint) {
  Scene scene = load_scene("kepler");
  scene.points[0].position = {Expression::parse("1"), Expression::parse("-2.25")};
  EXPECT_EQ(this->conserved(scene), "L_z - 2.25 P_x - P_y");
}

TYPED_TEST(Momenta, ConservedInLargeAndSmallUnits) {
  for (const char* unit : {"1.5e11", "3e-10"}) {
    Scene scene = load_scene("kepler");
    scene.bodies[0].position[0] = Expression::parse(unit);
    EXPECT_EQ(this->conserved(scene), "L_z") << unit;
    scene.effects.clear();
    EXPECT_EQ(this->conserved(scene), "P_x, P_y, L_z") << unit;
  }
}

/// A symmetry that is broken is broken however weakly.
TYPED_TEST(Momenta, ConservedBesideWeakEffects) {
  for (const std::string weak : {"1e-11", "1e-13", "1e-200"}) {
    const std::string spring = effect("spring", "between = [[\"a\", \"b\"]]\nstiffness = 1"),
                      trap = "exponent = 2\nstiffness = " + weak + "\ncenter = \"O\"",
                      heavy = effect("spring", "between = [[\"a\", \"b\"]]\nstiffness = 1e30");
    const auto gravity = [&](const char* before, const char* after) {
      return effect("uniform_gravity", "acceleration = [" + std::string(before) + weak + "\"" + after + "]");
    };
    EXPECT_EQ(this->conserved(plane_pair + spring + gravity("0, \"-", "")), "P_x") << weak;
    EXPECT_EQ(this->conserved(plane_pair + gravity("\"-", ", 0") + heavy), "P_y") << weak;
    EXPECT_EQ(this->conserved(plane_pair + spring + effect("trap", trap)), "L_z") << weak;
    EXPECT_EQ(this->conserved(plane_pair + heavy + effect("trap", trap + "\non = [\"b\"]")), "L_z") << weak;
    const std::string pull = effect("central_gravity", "strength = 1e20\ncenter = \"O\"");
    EXPECT_EQ(this->conserved(space_body + pull + gravity("0, \"", ", 0")), "L_y") << weak;
    EXPECT_EQ(this->conserved(
                  space_body + pull +
                  effect("oblateness", "center = \"O\"\nstrength = 1\nradius = 1\naxis = [1, 2, 2]\nJ2 = " + weak)),
              "L_x + 2 L_y + 2 L_z")
        << weak;
    EXPECT_EQ(this->conserved(space_body + pull + effect("trap", "exponent = 4\ncenter = \"A\"\nstiffness = " + weak)),
              "L_z")
        << weak;
    // One constraint or another is not stronger for its factor, whose square double still holds.
    const std::string factor = weak == "1e-200" ? "1e-150" : weak;
    EXPECT_EQ(this->conserved(space_body + pull +
                              constraint("plane", "body = \"a\"\nnormal = [0, 0, " + factor + "]\noffset = \"2/3*" +
                                                      factor + "\"")),
              "L_z")
        << weak;
  }
}

/// An effect with a factor 0 is none.
TYPED_TEST(Momenta, ConservedBesideEffectsThatVanish) {
  EXPECT_EQ(this->conserved(plane_pair + effect("uniform_gravity", "acceleration = [0, 0]")), "P_x, P_y, L_z");
  EXPECT_EQ(this->conserved(plane_pair + effect("trap", "stiffness = 0\nexponent = 2\ncenter = \"A\"")),
            "P_x, P_y, L_z");
  const std::string charged = R"(dimension = 2
point = [{ name = "O", position = [0, 0], charge = 1 }]
body = [{ name = "a", mass = 1, position = [1, 0], velocity = [0, 0], charge = )";
  const std::string coulomb = " }]\n" + effect("coulomb", "strength = 1");
  EXPECT_EQ(this->conserved(charged + "0" + coulomb), "P_x, P_y, L_z");
  EXPECT_EQ(this->conserved(charged + "1e-200" + coulomb), "L_z");
}

/// A light body counts as much as a heavy one, a constraint of small size as much as one of large.
TYPED_TEST(Momenta, ConservedWithALightBody) {
  for (const std::string light : {"1e-20", "1e-300"}) {
    const std::string bodies = R"(dimension = 2
point = [{ name = "O", position = [0, 0] }]
body = [{ name = "heavy", mass = 1, position = [1, 0], velocity = [0, 0] },
        { name = "light", mass = [[)" +
                               light + ", 0], [0, " + light + R"(]], position = [0, "1e-9"], velocity = [0, 0] }]
)";
    EXPECT_EQ(this->conserved(bodies), "P_x, P_y, L_z");
    EXPECT_EQ(this->conserved(bodies + effect("uniform_gravity", "acceleration = [0, -1]\non = [\"light\"]")), "P_x");
    EXPECT_EQ(this->conserved(bodies + effect("uniform_gravity", "acceleration = [0, \"-1e-200\"]")), "P_x");
    EXPECT_EQ(this->conserved(bodies + constraint("rod", "between = [\"light\", \"O\"]\nlength = 1e-9")), "L_z");
    // Not quite isotropic, by 100 units in the last place.
    Scene uneven = read_scene(bodies, "test.toml");
    uneven.constants.emplace("unit", Expression::parse(to_text(epsilon<TypeParam>())));
    (*uneven.bodies[1].mass_matrix)[1][1] = Expression::parse(light + "*(1 + 100*unit)");
    EXPECT_EQ(this->conserved(uneven), "P_x, P_y");
  }
}

/// The symmetry of two centres is the axis through them, however near or far they are.
TYPED_TEST(Momenta, ConservedAboutTheAxisThroughTwoCenters) {
  using S = TypeParam;
  for (const char* length : {"2^-300", "2^-40", "1", "2^37", "2^300"}) {
    const std::string text = R"(dimension = 3
constants = { l = ")" + std::string(length) +
                             R"(" }
point = [{ name = "A", position = ["l", "2*l", "7*l"] }, { name = "B", position = ["3*l", "5*l/2", "7*l"] }]
body = [{ name = "a", mass = 1, position = [0, 0, 0], velocity = [0, 0, 0] }]
)" + effect("trap", "stiffness = 1\nexponent = 2\ncenter = \"A\"") +
                             effect("trap", "stiffness = 1e-9\nexponent = 4\ncenter = \"B\"");
    const auto scene = assemble<S>(read_scene(text, "test.toml"));
    const auto components = conserved_momenta(scene.problem);
    ASSERT_EQ(components.size(), 1u) << length;
    // w.((q - A) x p) = w.L + (A x w).P with w = (1, 1/4, 0).
    EXPECT_EQ(components[0].angular, (Vector<S>(3) << S(1), S(1) / 4, S(0)).finished()) << length;
    const S l = literal<S>(length);
    EXPECT_EQ(components[0].linear, (Vector<S>(3) << -7 * l / 4, 7 * l, -7 * l / 4).finished()) << length;
  }
}

/// In units of powers of two the coefficients are the same, times that power.
TYPED_TEST(Momenta, ConservedInScaledUnits) {
  using S = TypeParam;
  const auto components = [](const std::string& unit) {
    const std::string text = "dimension = 2\nconstants = { l = \"" + unit + R"(", x = "pi", y = "-1/3" }
point = [{ name = "O", position = ["x*l", "y*l"] }]
body = [{ name = "a", mass = 1, position = [0, 0], velocity = [0, 0] }]
)" + effect("trap", "stiffness = 1\nexponent = 2\ncenter = \"O\"");
    return conserved_momenta(assemble<S>(read_scene(text, "test.toml")).problem);
  };
  const auto one = components("1");
  ASSERT_EQ(one.size(), 1u);
  for (const char* unit : {"2^-70", "2^-300", "2^200"}) {
    const auto other = components(unit);
    ASSERT_EQ(other.size(), 1u) << unit;
    EXPECT_EQ(other[0].angular, one[0].angular) << unit;
    EXPECT_EQ(other[0].linear, Vector<S>(one[0].linear * literal<S>(unit))) << unit;
  }
}

/// The angle at a body that sees two points under a right angle: a circle about their middle.
TYPED_TEST(Momenta, ConservedByAnAngleBetweenPoints) {
  EXPECT_EQ(
      this->conserved(plane_pair + constraint("angle", "first = [\"a\", \"O\"]\nsecond = [\"a\", \"A\"]\nvalue = 1")),
      "L_z + 1.5 P_x");
  // x.y = -13/9 there; the middle is (0, 0, 3/2), and the axis that of the two points
  EXPECT_EQ(
      this->conserved(space_body + constraint("angle", "first = [\"a\", \"O\"]\nsecond = [\"a\", \"A\"]\nvalue = -1")),
      "L_x + 1.5 P_y, L_y - 1.5 P_x, L_z");
  EXPECT_EQ(this->conserved(plane_pair +
                            constraint("angle", "first = [\"a\", \"b\"]\nsecond = [\"A\", \"O\"]\nvalue = \"-3/2\"")),
            "P_x, P_y");
}

/// The second route. It tells by how much forces, gradients of constraints and the kinetic energy change along every
/// motion of space at random points. The numbers of the problem are all about 1. Singular values tell what changes
/// nothing.
class MomentaBySampling : public ::testing::Test {
 protected:
  RandomValues<double> random{311};

  void expect_same(const Problem<double>& problem, const std::string& what) {
    const Index points = 20, m = problem.m(), nu = problem.nu();
    const auto axes = coordinate_momenta(problem);
    Matrix<double> rows(points * (nu + 2), static_cast<Index>(axes.size()));
    PotentialEvaluator<double> potential(problem.potential, 1);
    Matrix<double> force;
    Index row = 0;
    for (Index point = 0; point < points; ++point) {
      const Vector<double> q = random.vector(m) * 3, p = random.vector(m);
      Vector<double> v(m);
      problem.mass.velocity(lanes(p), lanes(v));
      potential.force(lanes(q), force);
      const Vector<double> f = force.row(0).transpose();
      const Matrix<double> G = dense_gradient(problem, q);
      for (Index j = 0; j < rows.cols(); ++j) {
        const auto& axis = axes[static_cast<std::size_t>(j)];
        rows(row, j) = momentum(problem, axis, q, f).value;
        for (Index a = 0; a < nu; ++a) rows(row + 1 + a, j) = momentum<double>(problem, axis, q, G.col(a)).value;
        rows(row + nu + 1, j) = axis.is_linear() ? 0 : momentum(problem, axis, p, v).value;
      }
      row += nu + 2;
    }
    const Vector<double> singular = Eigen::JacobiSVD<Matrix<double>>(rows).singularValues();
    const auto kept = conserved_momenta(problem);
    const auto vanishing = (singular.array() < 1e-9).count();
    EXPECT_EQ(static_cast<Index>(kept.size()), vanishing) << what << ": " << singular.transpose();
    for (const auto& component : kept) {
      Vector<double> x(rows.cols());
      for (Index j = 0; j < x.size(); ++j) {
        const auto& axis = axes[static_cast<std::size_t>(j)];
        x[j] = axis.linear.dot(component.linear) + axis.angular.dot(component.angular);
      }
      EXPECT_LE(max_norm(Vector<double>(rows * x)), 1e-9 * max_norm(x)) << what << ": " << component.name();
    }
  }
};

TEST_F(MomentaBySampling, OfEveryEffectAlone) {
  for (const Index d : {2, 3}) {
    const auto check = [&]<class Effect>() {
      for (const bool from_a_point : {false, true}) {
        EffectInput<double> input;
        input.kind = Effect::kind;
        input.dimension = d;
        for (const EffectKey& key : Effect::keys) {
          if (key.is_vector)
            input.vectors[std::string(key.name)] = std::vector<double>(static_cast<std::size_t>(d), 0.5);
          else
            input.numbers[std::string(key.name)] = key.name == "exponent" ? 4 : 0.75;
        }
        for (const Index body : {0, 1}) {
          EffectInput<double>::Instance instance;
          instance.x.blocks = {{body * d, 1}};
          if (from_a_point)
            instance.x.shift = random.vector(d);
          else if (Effect::acts == Acts::between_pairs)
            instance.x.blocks.push_back({(1 - body) * d, -1});
          instance.mass_matrix = body == 0 ? Matrix<double>(Matrix<double>::Identity(d, d)) : mass_block<double>(d);
          instance.masses[0] = instance.masses[1] = 1.5;
          instance.charges[0] = instance.charges[1] = -1.25;
          input.instances = {instance};
          Problem<double> problem = free_bodies<double>(d, {2, 3});
          problem.potential.terms.push_back(make_term(input));
          expect_same(problem, std::string(Effect::kind) + " in " + std::to_string(d) + " dimensions");
        }
      }
    };
    [&]<class... E>(std::tuple<E...>*) { (check.operator()<E>(), ...); }(static_cast<Effects*>(nullptr));
  }
}

TEST_F(MomentaBySampling, OfEveryConstraintAlone) {
  for (const Index d : {2, 3}) {
    const Problem<double> all = constrained_problem<double>(d);
    for (std::size_t a = 0; a < all.constraints.size(); ++a) {
      Problem<double> problem = free_bodies<double>(d, {2, 3, 1, 1});
      problem.constraints = {all.constraints[a]};
      expect_same(problem, all.constraints[a].name);
    }
    for_each_constraint_form<double>([&]<class Form>() {
      Problem<double> problem = free_bodies<double>(d, {2, 3, 1});
      problem.constraints = {any_constraint<Form>(d, random)};
      expect_same(problem, std::string(Form::kind) + " in " + std::to_string(d) + " dimensions");
    });
  }
}

TEST_F(MomentaBySampling, OfTheScenes) {
  for (const auto& [name, text] : built_in_scenes()) {
    const auto scene = assemble<double>(read_scene(text, name));
    // Differences of other constraints than quadratic ones are not exact.
    if (scene.problem.m() <= 12 && degree(scene.problem.constraints) == 2) expect_same(scene.problem, name);
  }
}

}  // namespace
}  // namespace hbvm::core

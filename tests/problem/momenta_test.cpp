#include "hbvm/problem/momenta.hpp"

#include "hbvm/scene/assemble.hpp"
#include "printing.hpp"
#include "scalar/random_values.hpp"
#include "scene/scene_text.hpp"

namespace hbvm {
namespace {

template <class S>
class Momenta : public ::testing::Test {
 protected:
  PrecisionScope digits{50};

  static Vector<S> vector(std::initializer_list<int> entries) {
    Vector<S> v(static_cast<Index>(entries.size()));
    Index i = 0;
    for (const int entry : entries) v[i++] = S(entry);
    return v;
  }

  static Problem<S> free_bodies(Index d, int count) {
    Problem<S> problem;
    problem.dimension = problem.potential.dimension = d;
    for (int body = 0; body < count; ++body) {
      problem.blocks.push_back({problem.m(), true});
      problem.mass.add_scalar(d, S(body + 1));
    }
    problem.potential.m = problem.m();
    return problem;
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
    return names(conserved_momenta(scene.problem, scene.q0));
  }
  static std::string conserved(const std::string& text) { return conserved(read_scene(text, "test.toml")); }
};
TYPED_TEST_SUITE(Momenta, AllScalars, ScalarNames);

TYPED_TEST(Momenta, OfTwoBodiesInThePlane) {
  const auto problem = this->free_bodies(2, 2);
  const auto P_and_L = this->along_axes(problem, this->vector({1, 2, 3, 5}), this->vector({7, 11, 13, 17}));
  EXPECT_EQ(P_and_L, (std::vector<TypeParam>{7 + 13, 11 + 17, (1 * 11 - 2 * 7) + (3 * 17 - 5 * 13)}));
}

TYPED_TEST(Momenta, OfABodyInSpaceIsTheCrossProduct) {
  const auto problem = this->free_bodies(3, 1);
  const auto P_and_L = this->along_axes(problem, this->vector({1, 2, 3}), this->vector({4, 5, 7}));
  EXPECT_EQ(P_and_L, (std::vector<TypeParam>{4, 5, 7, 2 * 7 - 3 * 5, 3 * 4 - 1 * 7, 1 * 5 - 2 * 4}));
}

TYPED_TEST(Momenta, AboutAnyAxisIsTheSumOfThoseAlongTheCoordinateAxes) {
  const auto problem = this->free_bodies(3, 1);
  const MomentumComponent<TypeParam> sum{this->vector({2, 2, 2}), this->vector({-1, -1, -1})};
  EXPECT_EQ(sum.name(), "2 L_x + 2 L_y + 2 L_z - P_x - P_y - P_z");
  EXPECT_EQ(momentum(problem, sum, this->vector({1, 2, 3}), this->vector({4, 5, 7})).value,
            2 * ((2 * 7 - 3 * 5) + (3 * 4 - 1 * 7) + (1 * 5 - 2 * 4)) - (4 + 5 + 7));
}

TYPED_TEST(Momenta, AreNamedByAxis) {
  EXPECT_EQ(this->names(coordinate_momenta(this->free_bodies(2, 1))), "P_x, P_y, L_z");
  EXPECT_EQ(this->names(coordinate_momenta(this->free_bodies(3, 1))), "P_x, P_y, P_z, L_x, L_y, L_z");
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
  const std::string gravity = effect("uniform_gravity", "acceleration = [0, -1]"),
                    mutual = effect("mutual_gravity", "strength = 1"), trap = "stiffness = 1\nexponent = 2\ncenter = ";
  EXPECT_EQ(this->conserved(plane_pair), "P_x, P_y, L_z");
  EXPECT_EQ(this->conserved(plane_pair + mutual), "P_x, P_y, L_z");
  EXPECT_EQ(this->conserved(plane_pair + gravity + mutual), "P_x");
  EXPECT_EQ(this->conserved(plane_pair + mutual + effect("trap", trap + "\"O\"")), "L_z");
  EXPECT_EQ(this->conserved(plane_pair + mutual + effect("trap", trap + "\"A\"")), "L_z + 3 P_x");
  EXPECT_EQ(this->conserved(plane_pair + effect("trap", trap + "\"O\"\non = [\"a\"]")), "L_z");
  EXPECT_EQ(this->conserved(plane_pair + constraint("rod", "between = [\"a\", \"b\"]\nlength = \"sqrt(5)/2\"")),
            "P_x, P_y, L_z");
  EXPECT_EQ(this->conserved(plane_pair + constraint("rod", "between = [\"a\", \"O\"]\nlength = 1")), "L_z");
  EXPECT_EQ(this->conserved(plane_pair + constraint("rod", "between = [\"b\", \"A\"]\nlength = 2.5")), "L_z + 3 P_x");
  EXPECT_EQ(this->conserved(plane_pair + constraint("plane", "body = \"a\"\nnormal = [0, 2]\noffset = 0")), "P_x");
  EXPECT_EQ(this->conserved(plane_pair +
                            constraint("angle", "first = [\"a\", \"b\"]\nsecond = [\"b\", \"a\"]\nvalue = -1.25")),
            "P_x, P_y, L_z");
}

TYPED_TEST(Momenta, ConservedInSpace) {
  const auto quadric = [](const std::string& A, const std::string& c) {
    return constraint("quadric", "body = \"a\"\nb = [0, 0, 0]\nA = " + A + "\nc = \"" + c + "\"");
  };
  const std::string gravity = effect("uniform_gravity", "acceleration = [0, 0, -1]"),
                    pull = "strength = 1\ncenter = ", sphere = quadric("[[1, 0, 0], [0, 1, 0], [0, 0, 1]]", "-1");
  EXPECT_EQ(this->conserved(space_body), "P_x, P_y, P_z, L_x, L_y, L_z");
  EXPECT_EQ(this->conserved(space_body + gravity), "P_x, P_y, L_z");
  EXPECT_EQ(this->conserved(space_body + effect("central_gravity", pull + "\"O\"")), "L_x, L_y, L_z");
  EXPECT_EQ(this->conserved(space_body + effect("central_gravity", pull + "\"A\"")), "L_x + 3 P_y, L_y - 3 P_x, L_z");
  EXPECT_EQ(
      this->conserved(space_body + effect("central_gravity", pull + "\"A\"") + effect("radial_cosine", pull + "\"O\"")),
      "L_z");
  EXPECT_EQ(this->conserved(space_body + sphere), "L_x, L_y, L_z");
  EXPECT_EQ(this->conserved(space_body + sphere + gravity), "L_z");
  EXPECT_EQ(this->conserved(space_body + quadric("[[2, 0, 0], [0, 1, 0], [0, 0, 1]]", "-13/9")), "L_x");
  EXPECT_EQ(this->conserved(space_body + quadric("[[2, 0, 0], [0, 1, 0], [0, 0, 3]]", "-21/9")), "");
  EXPECT_EQ(this->conserved(space_body + quadric("[[1, 0, 0], [0, 1, 0], [0, 0, 0]]", "-5/9")), "P_z, L_z");
  EXPECT_EQ(this->conserved(space_body + effect("oblateness", pull + "\"O\"\nradius = 1\nJ2 = 1\naxis = [0, 1, 0]")),
            "L_y");
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

}  // namespace
}  // namespace hbvm

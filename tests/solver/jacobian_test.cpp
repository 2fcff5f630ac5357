#include "solver/jacobian.hpp"

#include <random>

#include "printing.hpp"
#include "problem/in_double.hpp"
#include "scene/assemble.hpp"
#include "scene/scene.hpp"

namespace hbvm::core {
namespace {

/// Every effect that varies, a full mass matrix of a rigid body, and every form of constraint.
const char* const everything = R"(
dimension = 3
point = [{ name = "O", position = [0, 0, 0] }]
body = [
  { name = "a", mass = 2, charge = 1, position = [1, 0, 0], velocity = [0, 0, 0] },
  { name = "b", mass = 3, charge = -2, position = [1, 1, 0], velocity = [0, 0, 0] },
  { name = "c", mass = 1, charge = 1, position = [2, 1, 1], velocity = [0, 0, 0] },
]
constraint = [
  { kind = "rod", between = ["O", "a"], length = 1 },
  { kind = "rod", between = ["a", "b"], length = 1 },
  { kind = "angle", first = ["a", "O"], second = ["b", "a"], value = 0 },
]
effect = [
  { kind = "central_gravity", center = "O", strength = 1 },
  { kind = "mutual_gravity", strength = 0.3, between = [["a", "b"], ["b", "c"]] },
  { kind = "coulomb", strength = 0.7, between = [["a", "b"], ["a", "c"]] },
  { kind = "spring", stiffness = 2, rest_length = 0.5, between = [["a", "c"]] },
  { kind = "spring", stiffness = 2, exponent = 4, between = [["b", "c"]] },
  { kind = "trap", center = "O", stiffness = 0.5, exponent = 4 },
  { kind = "lennard_jones", depth = 0.1, diameter = 1, between = [["a", "c"]] },
  { kind = "radial_cosine", center = "O", strength = 1 },
  { kind = "oblateness", center = "O", strength = 1, radius = 0.5, J2 = 0.01, axis = [0, 1, 2] },
]
)";

template <class S>
void round_to_double(const Matrix<S>& from, Matrix<double>& to) {
  to.resize(from.rows(), from.cols());
  for (Index i = 0; i < from.size(); ++i) to.data()[i] = approximately(from.data()[i]);
}

/// J takes any direction to the derivative of the residual along it: by central differences with 60 digits.
void expect_derivative(const Scene& text, int k, int s, bool banded, int nodes = 0) {
  const PrecisionScope digits(60);
  const Assembled<Mpfr> scene = assemble<Mpfr>(text, Consistency::unchecked);
  const Hbvm<Mpfr> method = make_hbvm<Mpfr>(k, s, std::max(nodes, s));
  const Mpfr h = Mpfr(1) / 8;
  const Index m = scene.problem.m(), nu = scene.problem.nu();
  std::mt19937 random(17);
  const auto number = [&] { return Mpfr(static_cast<int>(random() % 201) - 100) / 128; };
  StageEquations<Mpfr> equations(scene.problem, method);
  StageUnknowns<Mpfr> x = equations.make_unknowns(), moved = x;
  for (Index j = 0; j < m; ++j)
    for (Index i = 0; i < s; ++i) x.gamma(i, j) = (i == 0 ? scene.p0[j] : Mpfr(0)) + number();
  for (Index i = 0; i < x.lambda.size(); ++i) x.lambda.data()[i] = number();
  Matrix<Mpfr> gamma_way = x.gamma, lambda_way = x.lambda;
  for (Index i = 0; i < gamma_way.size(); ++i) gamma_way.data()[i] = number();
  for (Index i = 0; i < lambda_way.size(); ++i) lambda_way.data()[i] = number();

  equations.start({scene.q0, scene.p0, h});
  StageResidual<Mpfr> r[2] = {{x.gamma, x.lambda}, {x.gamma, x.lambda}};
  const Mpfr small = ldexp(Mpfr(1), -60);
  for (const int side : {0, 1}) {
    const Mpfr step = side == 0 ? small : Mpfr(-small);
    moved.gamma = x.gamma + step * gamma_way;
    moved.lambda = x.lambda + step * lambda_way;
    equations.residual(moved, r[side]);
  }
  StageResidual<double> derivative;
  round_to_double<Mpfr>((r[0].momentum - r[1].momentum) / (2 * small), derivative.momentum);
  round_to_double<Mpfr>((r[0].constraint - r[1].constraint) / (2 * small), derivative.constraint);

  const Problem<double> problem = in_double(scene.problem);
  const Hbvm<double> rounded = make_hbvm<double>(k, s, std::max(nodes, s));
  StageEquations<double> at(problem, rounded);
  StageUnknowns<double> at_x = at.make_unknowns();
  round_to_double(x.gamma, at_x.gamma);
  round_to_double(x.lambda, at_x.lambda);
  Vector<double> q0(m), p0(m);
  for (Index j = 0; j < m; ++j) {
    q0[j] = approximately(scene.q0[j]);
    p0[j] = approximately(scene.p0[j]);
  }
  StageResidual<double> there{at_x.gamma, at_x.lambda};
  at.start({q0, p0, approximately(h)});
  at.residual(at_x, there);
  Jacobian jacobian(problem, rounded);
  EXPECT_EQ(jacobian.unknowns(), s * (m + nu));
  EXPECT_EQ(8 * jacobian.half_bandwidth() < jacobian.unknowns(), banded);
  ASSERT_TRUE(jacobian.factor(at, at_x.lambda));
  jacobian.solve(derivative);
  const double tolerance = 1'000'000 * epsilon<double>();  // the condition number of J, at most
  Matrix<double> expected;
  round_to_double(gamma_way, expected);
  EXPECT_LE(max_norm(Matrix<double>(derivative.momentum - expected)), tolerance) << text.name << " " << k << "," << s;
  round_to_double<Mpfr>(lambda_way * h, expected);
  EXPECT_LE(max_norm(Matrix<double>(derivative.constraint - expected)), tolerance) << text.name << " " << k << "," << s;
}

/// With constraints of any kind, at as many nodes as stages and at more.
TEST(Jacobian, IsTheDerivativeOfTheResidualOfAnyConstraint) {
  for (const auto& [k, s] : {std::pair(1, 1), {2, 2}, {5, 3}})
    for (const int r : {s, s + 1, s + 3})
      for (const char* name : {"bead_on_torus", "bead_on_quartic", "bead_on_helix", "bead_on_cycloid",
                               "rope_over_two_pegs", "rod_on_two_curves", "heavy_top"})
        expect_derivative(load_scene(name), k, s, false, r);
}

TEST(Jacobian, IsTheDerivativeOfTheResidual) {
  for (const auto& [k, s] : {std::pair(1, 1), {4, 1}, {2, 2}, {5, 3}}) {
    expect_derivative(read_scene(everything, "everything"), k, s, false);
    for (const char* name : {"tethered_satellites", "heavy_top", "bead_on_ellipsoid", "free_rigid_body", "kepler",
                             "quartic_oscillator", "scissors", "spring_and_plane"})
      expect_derivative(load_scene(name), k, s, false);
  }
}

/// A planar chain, with its bodies named in an order that hides it.
Scene chain(int n) {
  std::string bodies, rods;
  for (int i = 0; i < n; ++i) {
    const int along = (7 * i) % n + 1;
    bodies += "[[body]]\nname = \"" + std::to_string(along) + "\"\nmass = 1\nposition = [" + std::to_string(along) +
              ", 0]\nvelocity = [0, 0]\n";
    rods += "[[constraint]]\nkind = \"rod\"\nbetween = [\"" + std::to_string(i) + "\", \"" + std::to_string(i + 1) +
            "\"]\nlength = 1\n";
  }
  return read_scene("dimension = 2\n[[point]]\nname = \"0\"\nposition = [0, 0]\n" + bodies + rods +
                        "[[effect]]\nkind = \"uniform_gravity\"\nacceleration = [0, -1]\n",
                    "chain");
}

TEST(Jacobian, OfAChainIsBanded) {
  expect_derivative(chain(40), 2, 2, true);
  expect_derivative(chain(40), 4, 3, true);
}

}  // namespace
}  // namespace hbvm::core

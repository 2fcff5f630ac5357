#include "problem/force/force_input.hpp"

#include "printing.hpp"
#include "problem/effect/execution.hpp"
#include "scalar/literal.hpp"
#include "scalar/random_values.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

Expression formula(const std::string& text) { return Expression::parse(text, Expression::Syntax::formula); }

/// A force on displacements that are the first coordinates, one block each.
ForceInput<Mpfr> input_of(const std::string& kind, Index d, Index arguments, const Constants& constants) {
  ForceInput<Mpfr> input{kind, kind, false, d, arguments, arguments, constants};
  auto& instance = input.instances.emplace_back();
  for (Index a = 0; a < arguments; ++a) instance.x.push_back({{{a * d, Mpfr(1)}}, {}});
  return input;
}

class ForceInputTest : public InDigits<60> {
 protected:
  const Constants constants = {};
  RandomValues<Mpfr> random{31};

  static Vector<Mpfr> value(const ForceTerm<Mpfr>& term, Index d, const Vector<Mpfr>& q, const Vector<Mpfr>& v) {
    ForceInputs<Mpfr> inputs(term, d, 1);
    inputs.update(lanes(q), lanes(v));
    return outputs_of(term.force, term.force_coefficients, inputs.values()).row(0).transpose();
  }

  /// The derivatives against differences, with q and v changed in turn.
  void expect_slopes(const ForceTerm<Mpfr>& term, Index d, const Vector<Mpfr>& q, const Vector<Mpfr>& v) {
    ForceInputs<Mpfr> inputs(term, d, 1);
    inputs.update(lanes(q), lanes(v));
    const Matrix<Mpfr> slopes = outputs_of(term.slopes, term.slope_coefficients, inputs.values());
    const Mpfr step = literal<Mpfr>("1e-20"), small = literal<Mpfr>("1e-30");
    for (Index j = 0; j < 2 * q.size(); ++j) {
      Vector<Mpfr> x[2] = {q, v}, y[2] = {q, v};
      x[j / q.size()][j % q.size()] += step;
      y[j / q.size()][j % q.size()] -= step;
      const Vector<Mpfr> difference = (value(term, d, x[0], x[1]) - value(term, d, y[0], y[1])) / (2 * step);
      for (Index i = 0; i < difference.size(); ++i)
        EXPECT_LE(magnitude(Mpfr(difference[i] - slopes(0, i * 2 * q.size() + j))), small) << term.kind << i << j;
    }
  }
};

TEST_F(ForceInputTest, DamperPullsAlongTheLine) {
  for (const Index d : {1, 2, 3}) {
    ForceInput<Mpfr> input = input_of("damper", d, 1, constants);
    input.values["coefficient"] = {formula("3")};
    const ForceTerm<Mpfr> term = make_force(input);
    const Vector<Mpfr> x = random.vector(d), v = random.vector(d), F = value(term, d, x, v);
    const Mpfr rate = x.dot(v) / x.dot(x);
    EXPECT_LE(max_norm(Vector<Mpfr>(F + 3 * rate * x)), 64 * epsilon<Mpfr>());
    expect_slopes(term, d, x, v);
  }
}

TEST_F(ForceInputTest, DragIsAgainstTheVelocity) {
  ForceInput<Mpfr> input = input_of("drag", 3, 1, constants);
  input.values["linear"] = {formula("1/4")};
  input.values["quadratic"] = {formula("2")};
  const ForceTerm<Mpfr> term = make_force(input);
  const Vector<Mpfr> x = random.vector(3), v = random.vector(3), F = value(term, 3, x, v);
  const Mpfr factor = Mpfr(1) / 4 + 2 * sqrt(Mpfr(v.dot(v)));
  EXPECT_LE(max_norm(Vector<Mpfr>(F + factor * v)), 64 * epsilon<Mpfr>());
  expect_slopes(term, 3, x, v);
}

/// Without the quadratic part it has a derivative at rest.
TEST_F(ForceInputTest, LinearDragIsSmoothAtRest) {
  ForceInput<Mpfr> input = input_of("drag", 2, 1, constants);
  input.values["linear"] = {formula("1/4")};
  input.values["quadratic"] = {formula("0")};
  expect_slopes(make_force(input), 2, random.vector(2), Vector<Mpfr>::Zero(2));
}

TEST_F(ForceInputTest, MagneticForceDoesNoWork) {
  for (const Index d : {2, 3}) {
    ForceInput<Mpfr> input = input_of("magnetic_field", d, 1, constants);
    input.values["B"] =
        d == 2 ? std::vector{formula("1 + x*y")} : std::vector{formula("y"), formula("z/2"), formula("1 + x^2")};
    for (Index i = 0; i < d; ++i)
      input.variables[std::string(1, "xyz"[i])] = {FormulaVariable::Is::input, static_cast<std::size_t>(i)};
    input.parameters = 1;
    input.instances[0].parameters = {Mpfr(-3)};
    const ForceTerm<Mpfr> term = make_force(input);
    const Vector<Mpfr> x = random.vector(d), v = random.vector(d), F = value(term, d, x, v);
    EXPECT_LE(magnitude(Mpfr(F.dot(v))), 64 * epsilon<Mpfr>());
    if (d == 3) {
      const Mpfr Bx = x[1], By = x[2] / 2, Bz = 1 + x[0] * x[0];
      EXPECT_LE(magnitude(Mpfr(F[0] + 3 * (v[1] * Bz - v[2] * By))), 64 * epsilon<Mpfr>());
      EXPECT_LE(magnitude(Mpfr(F[1] + 3 * (v[2] * Bx - v[0] * Bz))), 64 * epsilon<Mpfr>());
    } else {
      const Mpfr B = 1 + x[0] * x[1];
      EXPECT_LE(magnitude(Mpfr(F[0] + 3 * v[1] * B)), 64 * epsilon<Mpfr>());
      EXPECT_LE(magnitude(Mpfr(F[1] - 3 * v[0] * B)), 64 * epsilon<Mpfr>());
    }
    expect_slopes(term, d, x, v);
  }
}

/// Of orthonormal directors the moments d x F add up to the torque, and F.d' to its power.
TEST_F(ForceInputTest, TorqueIsTheMomentOfItsForces) {
  ForceInput<Mpfr> input = input_of("torque", 3, 3, constants);
  input.values["value"] = {formula("2"), formula("-1"), formula("1/3")};
  const ForceTerm<Mpfr> term = make_force(input);
  Vector<Mpfr> directors(9), rates(9);
  directors << Mpfr(2) / 3, Mpfr(2) / 3, Mpfr(1) / 3, Mpfr(-2) / 3, Mpfr(1) / 3, Mpfr(2) / 3, Mpfr(1) / 3, Mpfr(-2) / 3,
      Mpfr(2) / 3;
  const Vector<Mpfr> omega = random.vector(3);
  const auto cross = [](const Vector<Mpfr>& a, const Vector<Mpfr>& b) {
    Vector<Mpfr> c(3);
    for (Index i = 0; i < 3; ++i) c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
    return c;
  };
  for (Index a = 0; a < 3; ++a) rates.segment(3 * a, 3) = cross(omega, directors.segment(3 * a, 3));
  const Vector<Mpfr> F = value(term, 3, directors, rates);
  Vector<Mpfr> moment = Vector<Mpfr>::Zero(3);
  for (Index a = 0; a < 3; ++a) moment += cross(directors.segment(3 * a, 3), F.segment(3 * a, 3));
  const Vector<Mpfr> w{{Mpfr(2), Mpfr(-1), Mpfr(1) / 3}};
  EXPECT_LE(distance(moment, w), 64 * epsilon<Mpfr>());
  EXPECT_LE(magnitude(Mpfr(F.dot(rates) - w.dot(omega))), 64 * epsilon<Mpfr>());
  expect_slopes(term, 3, directors, rates);
}

/// Along a direction in the frame of the body: 5 (2 d1 - d3), whatever the body has turned to.
TEST_F(ForceInputTest, TorqueAlongADirectionOfTheBody) {
  ForceInput<Mpfr> input = input_of("torque", 3, 3, constants);
  input.values["value"] = {formula("5")};
  input.values["along"] = {formula("2"), formula("0"), formula("-1")};
  const ForceTerm<Mpfr> along = make_force(input);
  Vector<Mpfr> directors(9);
  directors << Mpfr(2) / 3, Mpfr(2) / 3, Mpfr(1) / 3, Mpfr(-2) / 3, Mpfr(1) / 3, Mpfr(2) / 3, Mpfr(1) / 3, Mpfr(-2) / 3,
      Mpfr(2) / 3;
  // 5 (2 d1 - d3) = (5, 10, 0).
  input.values.erase("along");
  input.values["value"] = {formula("5"), formula("10"), formula("0")};
  const Vector<Mpfr> rates = random.vector(9);
  EXPECT_LE(distance(value(along, 3, directors, rates), value(make_force(input), 3, directors, rates)),
            64 * epsilon<Mpfr>());
  expect_slopes(along, 3, directors, rates);
}

TEST_F(ForceInputTest, TorqueInThePlaneAndBetweenTwo) {
  ForceInput<Mpfr> input = input_of("torque", 2, 4, constants);
  input.mutual = true;
  input.values["value"] = {formula("5")};
  const ForceTerm<Mpfr> term = make_force(input);
  const Vector<Mpfr> directors{
      {Mpfr(3) / 5, Mpfr(4) / 5, Mpfr(-4) / 5, Mpfr(3) / 5, Mpfr(0), Mpfr(1), Mpfr(-1), Mpfr(0)}};
  const Vector<Mpfr> F = value(term, 2, directors, Vector<Mpfr>::Zero(8));
  const auto moment = [&](Index first) {
    Mpfr sum = 0;
    for (Index a = first; a < first + 4; a += 2) sum += directors[a] * F[a + 1] - directors[a + 1] * F[a];
    return sum;
  };
  EXPECT_LE(magnitude(Mpfr(moment(0) - 5)), 64 * epsilon<Mpfr>());
  EXPECT_LE(magnitude(Mpfr(moment(4) + 5)), 64 * epsilon<Mpfr>());
}

/// The Coriolis force of a body and the centrifugal potential, of a rigid body with its inertia.
TEST_F(ForceInputTest, TurningFrame) {
  ForceInput<Mpfr> input = input_of("rotating_frame", 3, 2, constants);
  input.values["omega"] = {formula("1/2"), formula("1"), formula("-2")};
  input.values["center"] = {formula("1"), formula("0"), formula("0")};
  input.parameters = 4;
  input.instances[0].parameters = {Mpfr(3), Mpfr(1), Mpfr(1), Mpfr(2)};
  const ForceTerm<Mpfr> term = make_force(input);
  const Vector<Mpfr> x = random.vector(6), v = random.vector(6), F = value(term, 3, x, v);
  EXPECT_LE(magnitude(Mpfr(F.dot(v))), 256 * epsilon<Mpfr>());
  // -2 (m v_1 + c v_2) turned about omega, its first component.
  const Vector<Mpfr> sum = 3 * v.head(3) + v.tail(3);
  EXPECT_LE(magnitude(Mpfr(F[0] + 2 * (sum[2] + 2 * sum[1]))), 64 * epsilon<Mpfr>());
  expect_slopes(term, 3, x, v);
  const auto U = potential_beside(input);
  ASSERT_TRUE(U);
  const Matrix<Mpfr> at = x.transpose();
  Vector<Mpfr> r = x;
  r[0] -= 1;
  const auto turned = [](const Vector<Mpfr>& a) {
    return Vector<Mpfr>{{Mpfr(a[2] + 2 * a[1]), Mpfr(-2 * a[0] - a[2] / 2), Mpfr(a[1] / 2 - a[0])}};
  };
  const Vector<Mpfr> one = turned(r.head(3)), two = turned(r.tail(3));
  const Mpfr expected = (3 * one.dot(one) + 2 * one.dot(two) + 2 * two.dot(two)) / 2;
  EXPECT_LE(magnitude(Mpfr(outputs_of(U->value, U->value_coefficients, at)(0, 0) - expected)), 256 * epsilon<Mpfr>());
  EXPECT_FALSE(potential_beside(input_of("drag", 3, 1, constants)));
}

TEST_F(ForceInputTest, SaysWhichFormulaHasNoValue) {
  ForceInput<Mpfr> input = input_of("damper", 2, 1, constants);
  input.values["coefficient"] = {formula("1/(2 - 2)")};
  expect_words(message_of([&] { make_force(input); }), {"'coefficient'", "1/(2 - 2)", "division by 0"});
}

TEST_F(ForceInputTest, APointMovesAlongItsFormulas) {
  const DrivenPoint<Mpfr> point = driven_point<Mpfr>("p", {formula("sin(3*t)"), formula("t^2/2"), formula("7")}, {});
  const Mpfr t = Mpfr(5) / 8;
  const Matrix<Mpfr> found =
      outputs_of(point.course, Matrix<Mpfr>(1, 0), Matrix<Mpfr>(Matrix<Mpfr>::Constant(1, 1, t)));
  const Vector<Mpfr> expected{{sin(Mpfr(3 * t)), Mpfr(t * t / 2), Mpfr(7), Mpfr(3 * cos(Mpfr(3 * t))), t, Mpfr(0),
                               Mpfr(-9 * sin(Mpfr(3 * t))), Mpfr(1), Mpfr(0)}};
  EXPECT_LE(distance(Vector<Mpfr>(found.row(0).transpose()), expected), 64 * epsilon<Mpfr>());
  EXPECT_THROW(driven_point<Mpfr>("p", {formula("sqrt(t)")}, {}), InputError);
}

}  // namespace
}  // namespace hbvm::core

#include "problem/effect/input.hpp"

#include <array>
#include <cmath>
#include <set>
#include <tuple>

#include "hbvm/error.hpp"
#include "printing.hpp"
#include "problem/potential.hpp"
#include "scalar/literal.hpp"
#include "scalar/random_values.hpp"
#include "scalar/with_scalar.hpp"

namespace hbvm::core {
namespace {

using Numbers = std::map<std::string, Mpfr>;

/// One body or pair in high precision: what the formulas of physics speak of.
struct Things {
  Vector<Mpfr> x;
  Matrix<Mpfr> mass_matrix;
  Mpfr mass_a, mass_b, charge_a, charge_b;
  Vector<Mpfr> vector;

  Mpfr r() const {
    Mpfr sum = 0;
    for (const Mpfr& component : x) sum += component * component;
    return sqrt(sum);
  }
};

struct EffectCase {
  const char* kind;
  std::vector<std::pair<const char*, const char*>> numbers;  ///< exact in binary
  Mpfr (*U)(Numbers n, const Things& t);
  int degree = Trace<double>::not_polynomial;
  const char* vector_key = nullptr;
};

Mpfr spring_energy(Numbers n, const Things& t) {
  return -n["stiffness"] * pow(abs(Mpfr(t.r() - n["rest_length"])), n["exponent"]) / n["exponent"];
}

Mpfr trap_energy(Numbers n, const Things& t) { return -n["stiffness"] * pow(t.r(), n["exponent"]) / n["exponent"]; }

const std::vector<EffectCase>& effect_cases() {
  static const std::vector<EffectCase> cases{
      {"uniform_gravity",
       {},
       [](Numbers, const Things& t) {
         Mpfr sum = 0;
         for (Index i = 0; i < t.x.size(); ++i)
           for (Index j = 0; j < t.x.size(); ++j) sum += t.x[i] * t.mass_matrix(i, j) * t.vector[j];
         return sum;
       },
       1,
       "acceleration"},
      {"central_gravity",
       {{"strength", "0.375"}},
       [](Numbers n, const Things& t) { return Mpfr(n["strength"] * t.mass_a / t.r()); }},
      {"mutual_gravity",
       {{"strength", "0.375"}},
       [](Numbers n, const Things& t) { return Mpfr(n["strength"] * t.mass_a * t.mass_b / t.r()); }},
      {"coulomb",
       {{"strength", "1.25"}},
       [](Numbers n, const Things& t) { return Mpfr(-n["strength"] * t.charge_a * t.charge_b / t.r()); }},
      {"spring", {{"stiffness", "1.5"}, {"rest_length", "0"}, {"exponent", "2"}}, spring_energy, 2},
      {"spring", {{"stiffness", "1.5"}, {"rest_length", "1.5"}, {"exponent", "2"}}, spring_energy},
      {"spring", {{"stiffness", "1.5"}, {"rest_length", "0"}, {"exponent", "3"}}, spring_energy},
      {"spring", {{"stiffness", "1.5"}, {"rest_length", "1.5"}, {"exponent", "3"}}, spring_energy},
      {"spring", {{"stiffness", "1.5"}, {"rest_length", "0"}, {"exponent", "4"}}, spring_energy, 4},
      {"spring", {{"stiffness", "1.5"}, {"rest_length", "1.5"}, {"exponent", "4"}}, spring_energy},
      {"spring", {{"stiffness", "2"}, {"rest_length", "0"}, {"exponent", "6"}}, spring_energy, 6},
      {"spring", {{"stiffness", "2"}, {"rest_length", "1.5"}, {"exponent", "7"}}, spring_energy},
      {"spring", {{"stiffness", "2"}, {"rest_length", "0"}, {"exponent", "2.5"}}, spring_energy},
      {"spring", {{"stiffness", "2"}, {"rest_length", "1.5"}, {"exponent", "2.5"}}, spring_energy},
      {"trap", {{"stiffness", "0.75"}, {"exponent", "2"}}, trap_energy, 2},
      {"trap", {{"stiffness", "0.75"}, {"exponent", "4"}}, trap_energy, 4},
      {"lennard_jones",
       {{"depth", "0.5"}, {"diameter", "1.25"}},
       [](Numbers n, const Things& t) {
         const Mpfr ratio = n["diameter"] / t.r();
         return Mpfr(-4 * n["depth"] * (pow(ratio, 12) - pow(ratio, 6)));
       }},
      {"radial_cosine",
       {{"strength", "0.5"}},
       [](Numbers n, const Things& t) { return Mpfr(n["strength"] * cos(t.r())); }},
      {"oblateness",
       {{"strength", "1.5"}, {"radius", "0.5"}, {"J2", "0.25"}},
       [](Numbers n, const Things& t) {
         Mpfr along = 0, axis = 0;
         for (Index i = 0; i < t.x.size(); ++i) {
           along += t.vector[i] * t.x[i];
           axis += t.vector[i] * t.vector[i];
         }
         const Mpfr sine = along / (sqrt(axis) * t.r()), legendre_2 = (3 * sine * sine - 1) / 2;
         return Mpfr(-n["strength"] * t.mass_a / t.r() * n["J2"] * pow(Mpfr(n["radius"] / t.r()), 2) * legendre_2);
       },
       Trace<double>::not_polynomial,
       "axis"},
  };
  return cases;
}

/// Three instances that share three bodies: a pair, a body and a fixed point, and a weighted displacement. All numbers
/// but the random positions are exact in binary.
template <Scalar S>
EffectInput<S> use_of(const EffectCase& effect, Index d) {
  EffectInput<S> input;
  input.kind = effect.kind;
  input.dimension = d;
  for (const auto& [key, text] : effect.numbers) input.numbers.emplace(key, literal<S>(text));
  if (effect.vector_key != nullptr) {
    const std::vector<S> components{S(1), S(-2), S(3) / 2};
    input.vectors.emplace(effect.vector_key, std::vector<S>(components.begin(), components.begin() + d));
  }
  const auto shift = [&](const S& a, const S& b, const S& c) {
    const S components[] = {a, b, c};
    Vector<S> v(d);
    for (Index j = 0; j < d; ++j) v[j] = components[j];
    return v;
  };
  const Displacement<S> displacements[] = {{{{0, S(1)}, {d, S(-1)}}, {}},
                                           {{{2 * d, S(1)}}, shift(S(-1) / 2, S(-1) / 4, S(1))},
                                           {{{d, S(1) / 2}, {2 * d, S(1) / 4}}, shift(S(1) / 8, S(1), S(0))}};
  int n = 0;
  for (const Displacement<S>& x : displacements) {
    ++n;
    typename EffectInput<S>::Instance instance;
    instance.x = x;
    instance.mass_matrix = Matrix<S>(d, d);
    for (Index i = 0; i < d; ++i)
      for (Index j = 0; j < d; ++j) instance.mass_matrix(i, j) = S(i == j ? 8 * n : i + j) / 8;
    instance.masses[0] = S(n);
    instance.masses[1] = S(n + 1) / 2;
    instance.charges[0] = S(2 * n - 5) / 4;
    instance.charges[1] = S(n + 2);
    input.instances.push_back(std::move(instance));
  }
  return input;
}

/// Positions of three bodies that keep all distances between 1/2 and 4.
template <Scalar S>
Matrix<S> positions(RandomValues<S>& random, Index lanes, Index d) {
  const int base[3][3] = {{0, 0, 0}, {4, 4, 2}, {8, -4, 4}};
  Matrix<S> q(lanes, 3 * d);
  for (Index body = 0; body < 3; ++body)
    for (Index j = 0; j < d; ++j)
      for (Index i = 0; i < lanes; ++i) q(i, body * d + j) = (S(base[body][j]) + random.value()) / 4;
  return q;
}

/// The same use in the precision of the scope, where the formulas of this file are evaluated.
class Formula {
 public:
  template <Scalar S>
  Formula(const EffectCase& effect, const EffectInput<S>& input) : effect_(effect), d_(input.dimension) {
    for (const auto& [key, value] : input.numbers) numbers_.emplace(key, exact(value));
    for (const auto& instance : input.instances) {
      Things things;
      things.mass_matrix = Matrix<Mpfr>(d_, d_);
      for (Index i = 0; i < d_ * d_; ++i) things.mass_matrix.data()[i] = exact(instance.mass_matrix.data()[i]);
      things.mass_a = exact(instance.masses[0]);
      things.mass_b = exact(instance.masses[1]);
      things.charge_a = exact(instance.charges[0]);
      things.charge_b = exact(instance.charges[1]);
      if (effect.vector_key != nullptr) {
        const auto& vector = input.vectors.find(effect.vector_key)->second;
        things.vector = Vector<Mpfr>(d_);
        for (Index j = 0; j < d_; ++j) things.vector[j] = exact(vector[static_cast<std::size_t>(j)]);
      }
      Displacement<Mpfr> x;
      for (const auto& block : instance.x.blocks) x.blocks.push_back({block.offset, exact(block.weight)});
      x.shift = Vector<Mpfr>::Zero(d_);
      for (Index j = 0; j < instance.x.shift.size(); ++j) x.shift[j] = exact(instance.x.shift[j]);
      things_.push_back(std::move(things));
      displacements_.push_back(std::move(x));
    }
  }

  template <Scalar S>
  static Mpfr exact(const S& x) {
    return rounded_to<Mpfr>(raw(exactly(x)));
  }

  Mpfr U(const Vector<Mpfr>& q) const {
    Mpfr sum = 0;
    for (std::size_t n = 0; n < things_.size(); ++n) {
      Things things = things_[n];
      things.x = displacements_[n].shift;
      for (const auto& block : displacements_[n].blocks)
        for (Index j = 0; j < d_; ++j) things.x[j] += block.weight * q[block.offset + j];
      sum += effect_.U(numbers_, things);
    }
    return sum;
  }

  Vector<Mpfr> gradient(const Vector<Mpfr>& q, const Mpfr& h) const {
    Vector<Mpfr> result(q.size());
    for (Index i = 0; i < q.size(); ++i) {
      Vector<Mpfr> before = q, after = q;
      before[i] -= h;
      after[i] += h;
      result[i] = (U(after) - U(before)) / (2 * h);
    }
    return result;
  }

 private:
  const EffectCase& effect_;
  Index d_;
  Numbers numbers_;
  std::vector<Things> things_;
  std::vector<Displacement<Mpfr>> displacements_;
};

template <Scalar S>
void expect_formula(const EffectCase& effect, Index d) {
  constexpr Index count = 3;
  RandomValues<S> random(71);
  const EffectInput<S> input = use_of<S>(effect, d);
  Potential<S> potential;
  potential.dimension = d;
  potential.m = 3 * d;
  potential.terms.push_back(make_term(input));
  EXPECT_EQ(potential.terms[0].kind, effect.kind);
  EXPECT_EQ(potential.terms[0].degree, effect.degree);
  EXPECT_EQ(potential.terms[0].constant_force, effect.degree == 1);

  PotentialEvaluator<S> evaluator(potential, count);
  const Matrix<S> q = positions(random, count, d);
  Vector<S> U;
  Matrix<S> force;
  evaluator.values(lanes(q), U);
  evaluator.force(lanes(q), force);
  ASSERT_EQ(U.size(), count);

  const int working = digits10<S>();
  const S eps = epsilon<S>();
  const PrecisionScope reference(static_cast<unsigned>(2 * working + 60));
  const Formula formula(effect, input);
  // A power of the distance amplifies the rounding of the displacement by the exponent, 14 at most.
  const Mpfr tolerance = 500 * Formula::exact(eps), h = pow(Mpfr(10), -working - 10);
  for (Index i = 0; i < count; ++i) {
    Vector<Mpfr> position(3 * d);
    for (Index j = 0; j < 3 * d; ++j) position[j] = Formula::exact(q(i, j));
    const Mpfr expected_U = formula.U(position);
    EXPECT_LE(magnitude(Mpfr(Formula::exact(U[i]) - expected_U)), tolerance * (1 + magnitude(expected_U)));
    const Vector<Mpfr> expected = formula.gradient(position, h);
    const Mpfr bound = tolerance * (1 + max_norm(expected));
    for (Index j = 0; j < 3 * d; ++j)
      EXPECT_LE(magnitude(Mpfr(Formula::exact(force(i, j)) - expected[j])), bound) << "coordinate " << j;
  }
}

TEST(Effects, AgreeWithPhysicsAndFiniteDifferences) {
  for (const EffectCase& effect : effect_cases())
    for (const Index d : {2, 3})
      for (const char* precision : {"double", "quad", "mpfr:60"}) {
        std::string numbers;
        for (const auto& [key, text] : effect.numbers) numbers += std::string(", ") + key + " " + text;
        SCOPED_TRACE(effect.kind + numbers + ", " + std::to_string(d) + " dimensions, " + precision);
        with_scalar(Precision::parse(precision), [&]<Scalar S>() { expect_formula<S>(effect, d); });
      }
}

TEST(Effects, AreAllTestedHere) {
  std::set<std::string_view> tested, known;
  for (const EffectCase& effect : effect_cases()) tested.insert(effect.kind);
  std::apply([&](auto... effect) { (known.insert(decltype(effect)::kind), ...); }, Effects{});
  EXPECT_EQ(tested, known);
  EXPECT_EQ(known.size(), std::tuple_size_v<Effects>) << "two effects of one kind";
}

TEST(Effects, AreFoundByKind) {
  std::string found;
  EXPECT_TRUE(with_effect("trap", [&]<class Effect>() { found += Effect::kind; }));
  EXPECT_EQ(found, "trap");
  EXPECT_FALSE(with_effect("Trap", [&]<class Effect>() { found += Effect::kind; }));
  EXPECT_FALSE(with_effect("", [&]<class Effect>() { found += Effect::kind; }));
  EXPECT_EQ(found, "trap");
}

template <class S>
class Term : public InDigits<50> {
 protected:
  static EffectInput<S> one_body(const char* kind, const std::vector<std::pair<const char*, const char*>>& numbers) {
    EffectInput<S> input;
    input.kind = kind;
    input.dimension = 2;
    for (const auto& [key, text] : numbers) input.numbers.emplace(key, literal<S>(text));
    typename EffectInput<S>::Instance instance;
    instance.x = {{{0, S(1)}}, {}};
    instance.mass_matrix = Matrix<S>::Identity(2, 2);
    input.instances.push_back(instance);
    return input;
  }

  static EffectInput<S> spring(const char* exponent, const char* rest_length) {
    return one_body("spring", {{"stiffness", "1"}, {"rest_length", rest_length}, {"exponent", exponent}});
  }

  static Matrix<S> force_at(const EffectInput<S>& input, const S& x, const S& y) {
    const Potential<S> potential{2, 2, {make_term(input)}};
    PotentialEvaluator<S> evaluator(potential, 1);
    Matrix<S> q(1, 2), force;
    q << x, y;
    evaluator.varying_force(lanes(std::as_const(q)), force);
    return force;
  }
};
TYPED_TEST_SUITE(Term, AllScalars, ScalarNames);

TYPED_TEST(Term, RefusesAnUnknownKind) { EXPECT_THROW(make_term(this->one_body("magnet", {})), Error); }

TYPED_TEST(Term, RefusesExponentsOfATrapOtherThanTwoAndFour) {
  for (const char* exponent : {"1", "3", "0", "-2", "6", "2.5"})
    EXPECT_THROW(make_term(this->one_body("trap", {{"stiffness", "1"}, {"exponent", exponent}})), InputError)
        << exponent;
}

TYPED_TEST(Term, RefusesExponentsOfASpringBelowTwoAndAboveAThousand) {
  for (const char* length : {"0", "1"}) {
    for (const char* exponent : {"1", "0", "-2", "1001", "1.5", "0.5", "-2.5", "1000.5", "2000000"})
      EXPECT_THROW(make_term(this->spring(exponent, length)), InputError) << exponent << " " << length;
    for (const char* exponent : {"2", "3", "1000", "999", "2.5", "999.5"})
      EXPECT_NO_THROW(make_term(this->spring(exponent, length))) << exponent << " " << length;
  }
}

TYPED_TEST(Term, ASpringAtItsRestLengthDoesNotPull) {
  for (const char* exponent : {"2", "3", "4", "5"}) {
    const auto force = this->force_at(this->spring(exponent, "5"), TypeParam(3), TypeParam(4));
    EXPECT_EQ(max_norm(force), 0) << exponent;
  }
}

TYPED_TEST(Term, ASpringWithoutLengthDoesNotPullAtItsEnd) {
  for (const char* exponent : {"2", "4"}) {
    const auto force = this->force_at(this->spring(exponent, "0"), TypeParam(0), TypeParam(0));
    EXPECT_EQ(max_norm(force), 0) << exponent;
  }
}

TYPED_TEST(Term, AnOddSpringPullsBackOnBothSides) {
  EXPECT_EQ(this->force_at(this->spring("3", "5"), TypeParam(6), TypeParam(0))(0, 0), -1);
  EXPECT_EQ(this->force_at(this->spring("3", "5"), TypeParam(4), TypeParam(0))(0, 0), 1);
}

TYPED_TEST(Term, PolynomialsNeedNoRoot) {
  for (const char* exponent : {"2", "4", "6"}) {
    const auto spring = make_term(this->spring(exponent, "0"));
    for (const OperationCounts& operations : {spring.value.operations(), spring.gradient.operations()}) {
      EXPECT_EQ(operations[Op::sqrt], 0u);
      EXPECT_EQ(operations[Op::reciprocal], 0u);
    }
  }
}

TYPED_TEST(Term, CostOfCentralGravity) {
  const auto gravity = make_term(this->one_body("central_gravity", {{"strength", "3"}}));
  OperationCounts expected;
  expected.add(Op::multiply, 7);
  expected.add(Op::add, 1);
  expected.add(Op::sqrt, 1);
  expected.add(Op::reciprocal, 1);
  EXPECT_EQ(gravity.gradient.operations(), expected);
}

}  // namespace
}  // namespace hbvm::core

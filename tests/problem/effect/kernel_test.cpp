#include "problem/effect/kernel.hpp"

#include <gtest/gtest.h>

#include "clock.hpp"
#include "problem/effect/input.hpp"
#include "scene/assemble.hpp"
#include "scene/scene.hpp"

namespace hbvm::core {
namespace {

using Instance = EffectInput<double>::Instance;

/// U(x) in every lane of a term, by its interpreted gradient program alone.
Matrix<double> interpreted(const EffectTerm<double>& term, Index dimension, const Matrix<double>& q) {
  Matrix<double> force = Matrix<double>::Zero(q.rows(), q.cols());
  for (std::size_t n = 0; n < term.displacements.size(); ++n) {
    Matrix<double> x(q.rows(), dimension);
    displace(term.displacements[n], dimension, lanes(q), x.data(), x.rows());
    Matrix<double> coefficients(q.rows(), term.gradient_coefficients.cols());
    for (Index i = 0; i < q.rows(); ++i) coefficients.row(i) = term.gradient_coefficients.row(static_cast<Index>(n));
    std::vector<const double*> inputs;
    for (Index j = 0; j < dimension; ++j) inputs.push_back(x.data() + j * x.rows());
    for (Index j = 0; j < coefficients.cols(); ++j) inputs.push_back(coefficients.data() + j * coefficients.rows());
    Matrix<double> registers = term.gradient.make_registers(q.rows());
    term.gradient.run(registers, inputs);
    for (const auto& block : term.displacements[n].blocks)
      for (Index j = 0; j < dimension; ++j)
        for (Index i = 0; i < q.rows(); ++i)
          force(i, block.offset + j) +=
              block.weight * term.gradient.output(static_cast<std::size_t>(j), i, registers, inputs);
  }
  return force;
}

/// The same of a potential, as it is evaluated.
Matrix<double> evaluated(const Potential<double>& potential, const Matrix<double>& q) {
  PotentialEvaluator<double> evaluator(potential, q.rows());
  Matrix<double> force;
  evaluator.varying_force(lanes(q), force);
  return force;
}

Instance body(Index offset, Index dimension, std::vector<double> center) {
  Instance instance;
  instance.x.blocks = {{offset, 1}};
  if (!center.empty()) {
    instance.x.shift.resize(dimension);
    for (Index j = 0; j < dimension; ++j) instance.x.shift[j] = -center[static_cast<std::size_t>(j)];
  }
  instance.mass_matrix = Matrix<double>::Identity(dimension, dimension);
  instance.masses[0] = 1.5;
  instance.masses[1] = 0.75;
  instance.charges[0] = -2;
  instance.charges[1] = 3;
  return instance;
}

Instance pair(Index a, Index b, Index dimension) {
  Instance instance = body(a, dimension, {});
  instance.x.blocks.push_back({b, -1});
  return instance;
}

Matrix<double> positions(Index lanes, Index m) {
  Matrix<double> q(lanes, m);
  for (Index i = 0; i < lanes; ++i)
    for (Index j = 0; j < m; ++j) q(i, j) = std::sin(1.7 * double(j * j) + 0.3 * double(i)) + 0.4 * double(j);
  return q;
}

EffectInput<double> spring(double exponent, double rest_length, Index dimension) {
  return {"spring",
          dimension,
          {{"stiffness", 1.3}, {"rest_length", rest_length}, {"exponent", exponent}},
          {},
          {pair(dimension, 0, dimension), pair(0, 2 * dimension, dimension)}};
}

/// The compiled kernel does the interpreter's operations in its order: equal to the last bit.
TEST(Kernel, IsTheProgram) {
  for (const Index d : {2, 3}) {
    std::vector<EffectInput<double>> uses{
        {"central_gravity", d, {{"strength", 2.0}}, {}, {body(0, d, {}), body(d, d, {0.25, -3, 1})}},
        {"mutual_gravity", d, {{"strength", 0.1}}, {}, {pair(0, d, d), pair(2 * d, d, d)}},
        {"coulomb", d, {{"strength", 7.0}}, {}, {pair(0, d, d), pair(0, 2 * d, d)}},
        {"lennard_jones", d, {{"depth", 0.3}, {"diameter", 1.1}}, {}, {pair(0, d, d)}},
        {"radial_cosine", d, {{"strength", 1.0}}, {}, {body(d, d, {}), body(0, d, {1, 1, 1})}},
        {"trap", d, {{"stiffness", 2.5}, {"exponent", 2.0}}, {}, {body(0, d, {0.5, 0.5, 0.5})}},
        {"trap", d, {{"stiffness", 2.5}, {"exponent", 4.0}}, {}, {body(2 * d, d, {})}},
    };
    for (const double exponent : {2.0, 2.75, 3.0, 4.0})
      for (const double rest_length : {0.0, 0.9}) uses.push_back(spring(exponent, rest_length, d));
    for (const double first : {0.0, 0.6}) {
      std::vector<double> axis(static_cast<std::size_t>(d), first);
      axis.back() = 0.8;
      uses.push_back({"oblateness",
                      d,
                      {{"strength", 1.2}, {"radius", 0.7}, {"J2", 0.01}},
                      {{"axis", axis}},
                      {body(0, d, {}), body(d, d, {1, 2, 3})}});
    }
    for (const EffectInput<double>& input : uses) {
      const Potential<double> potential{d, 3 * d, {make_term(input)}};
      ASSERT_NE(find_kernel(potential.terms[0].gradient, d), nullptr) << input.kind << " in " << d;
      for (const Index count : {1, 2, 5, 8, 35}) {
        const Matrix<double> q = positions(count, 3 * d);
        EXPECT_EQ(evaluated(potential, q), interpreted(potential.terms[0], d, q))
            << input.kind << " in " << d << ", lanes " << count;
      }
    }
  }
}

EffectInput<double> about_a_centre(std::string kind, Index d) {
  EffectInput<double> input{std::move(kind), d, {{"strength", 1.2}}, {}, {body(0, d, {}), body(d, d, {0.25, -3, 1})}};
  if (input.kind == "oblateness") {
    input.numbers.insert({{"radius", 0.7}, {"J2", 0.01}});
    input.vectors["axis"] = std::vector<double>(static_cast<std::size_t>(d), 0.0);
    input.vectors["axis"].back() = 1;
  }
  return input;
}

/// A program that calls functions has a step before the first, one between two, and one after the last.
TEST(Kernel, StepsAreWhatIsBetweenTheCallsOfFunctions) {
  const auto count = [](const std::string& text, const std::string& word) {
    long found = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
    return found;
  };
  const auto steps = [](const EffectInput<double>& input) {
    return cpp_steps(make_term(input).gradient, input.dimension);
  };
  EXPECT_EQ(steps(about_a_centre("central_gravity", 3)), "");
  const std::string sine = steps(about_a_centre("radial_cosine", 3)), power = steps(spring(2.75, 0.5, 2));
  EXPECT_EQ(count(sine, "for_each_lane("), 2);
  EXPECT_EQ(count(sine, "std::sin("), 1);
  EXPECT_EQ(count(sine, "std::sqrt("), 1);
  EXPECT_EQ(count(sine, "add(i, g)"), 1);
  EXPECT_EQ(count(power, "for_each_lane("), 1 + count(power, "for (Index i"));
  EXPECT_EQ(count(power, "std::log("), 1);
  EXPECT_EQ(count(power, "std::exp("), 1);
  EXPECT_EQ(count(power, "add(i, g)"), 1);
}

/// Fields of one centre are computed together, one effect after the other as each alone, to the last bit. With a time
/// for each they are done apart.
TEST(Kernel, FieldsOfOneCentreHaveOneTogether) {
  for (const Index d : {2, 3})
    for (const char* other : {"radial_cosine", "oblateness"})
      for (const bool first : {false, true}) {
        Potential<double> potential{d, 3 * d, {}};
        for (const std::string& kind : first ? std::vector<std::string>{"central_gravity", other}
                                             : std::vector<std::string>{other, "central_gravity"})
          potential.terms.push_back(make_term(about_a_centre(kind, d)));
        for (const Index count : {1, 3, 8, 35}) {
          PotentialEvaluator<double> together(potential, count), timed(potential, count);
          const Matrix<double> q = positions(count, 3 * d);
          Matrix<double> force, apart;
          together.varying_force(lanes(q), force);
          {
            const MeasuredParts measured;
            timed.varying_force(lanes(q), apart);
          }
          Matrix<double> expected = interpreted(potential.terms[0], d, q);
          expected += interpreted(potential.terms[1], d, q);
          EXPECT_EQ(force, expected) << other << " in " << d << ", lanes " << count;
          EXPECT_EQ(apart, expected) << other << " in " << d << ", lanes " << count;
          EXPECT_EQ(together.counts()[0].done_before.total(), 0u);
          EXPECT_GE(together.counts()[1].done_before[Op::sqrt], 2u);
          EXPECT_EQ(together.counts()[1].evaluations, timed.counts()[1].evaluations);
          for (const EffectCount& alone : timed.counts()) EXPECT_EQ(alone.done_before.total(), 0u);
        }
      }
}

/// Neither about one centre nor in one kernel: each by itself.
TEST(Kernel, EffectsWithoutOneTogetherAreDoneApart) {
  for (const char* kind : {"trap", "radial_cosine"}) {
    EffectInput<double> other{
        kind, 2, {{"stiffness", 2.5}, {"exponent", 4.0}}, {}, {body(0, 2, {}), body(2, 2, {0.25, -3})}};
    if (kind == std::string("radial_cosine")) {
      other.numbers = {{"strength", 1.5}};
      other.instances = {body(0, 2, {}), body(2, 2, {0.25, -2})};
    }
    const Potential<double> potential{2, 6, {make_term(about_a_centre("central_gravity", 2)), make_term(other)}};
    PotentialEvaluator<double> evaluator(potential, 2);
    const Matrix<double> q = positions(2, 6);
    Matrix<double> force;
    evaluator.varying_force(lanes(q), force);
    Matrix<double> expected = interpreted(potential.terms[0], 2, q);
    expected += interpreted(potential.terms[1], 2, q);
    EXPECT_EQ(force, expected) << kind;
    EXPECT_EQ(evaluator.counts()[1].done_before.total(), 0u) << kind;
  }
}

TEST(Kernel, ARareExponentIsInterpreted) {
  const Potential<double> potential{2, 6, {make_term(spring(7, 0.5, 2))}};
  EXPECT_EQ(find_kernel(potential.terms[0].gradient, 2), nullptr);
  const Matrix<double> q = positions(3, 6);
  EXPECT_EQ(evaluated(potential, q), interpreted(potential.terms[0], 2, q));
}

/// A centre of a rigid body, of four blocks, has no site.
TEST(Kernel, SitesAreBodiesAndPairs) {
  Displacement<double> x;
  EXPECT_FALSE(kernel_site(x));
  x.blocks = {{3, 1}};
  EXPECT_EQ(kernel_site(x)->a, 3);
  EXPECT_EQ(kernel_site(x)->b, -1);
  x.shift = Vector<double>::Constant(2, 0.5);
  EXPECT_EQ(kernel_site(x)->shift, (std::array{0.5, 0.5, 0.0}));
  x.blocks.push_back({6, -1});
  EXPECT_FALSE(kernel_site(x));
  x.shift.resize(0);
  EXPECT_EQ(kernel_site(x)->b, 6);
  x.blocks[1].weight = 0.5;
  EXPECT_FALSE(kernel_site(x));
  x.blocks[1].weight = -1;
  x.blocks.push_back({9, 1});
  EXPECT_FALSE(kernel_site(x));
}

TEST(Kernel, EveryShippedSceneUsesThem) {
  for (const auto& [name, text] : built_in_scenes()) {
    const auto scene = assemble<double>(load_scene(name));
    const Potential<double>& potential = scene.problem.potential;
    for (const EffectTerm<double>& term : potential.terms)
      // A formula is compiled only if an effect has the same.
      if (!term.constant_force && term.kind != "formula") {
        EXPECT_NE(find_kernel(term.gradient, potential.dimension), nullptr) << name << ": " << term.kind;
      }
  }
}

}  // namespace
}  // namespace hbvm::core

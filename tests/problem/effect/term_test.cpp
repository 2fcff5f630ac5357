#include "problem/effect/term.hpp"

#include "printing.hpp"
#include "problem/effect/execution.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {
namespace {

/// Every program of a term with the rounded numbers gives what the term does, but for rounding.
TEST(EffectTermInDouble, DoesTheSame) {
  const PrecisionScope digits(50);
  for (const char* name : {"toda_lattice", "satellites_with_oblateness", "charged_tetrahedron", "henon_heiles"}) {
    const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene(name));
    const Index d = scene.problem.dimension;
    for (const EffectTerm<Mpfr>& term : scene.problem.potential.terms) {
      const EffectTerm<double> rounded = in_double(term);
      EXPECT_EQ(rounded.kind, term.kind);
      EXPECT_EQ(rounded.degree, term.degree);
      EXPECT_EQ(rounded.constant_force, term.constant_force);
      ASSERT_EQ(rounded.instances(), term.instances());
      const auto outputs = [&](const auto& of, auto q) {
        using S = typename decltype(q)::Scalar;
        Matrix<S> x = Matrix<S>::Zero(of.instances(), of.arguments * d);
        displace(of, d, lanes(std::as_const(q)), x.data(), x.rows());
        std::vector<double> all;
        for (const auto& [program, coefficients] : {std::pair(&of.value, &of.value_coefficients),
                                                    {&of.gradient, &of.gradient_coefficients},
                                                    {&of.hessian, &of.hessian_coefficients}}) {
          Execution<S> execution(*program, *coefficients, x, 1);
          execution.run();
          for (std::size_t i = 0; i < program->outputs(); ++i)
            for (Index n = 0; n < of.instances(); ++n)
              all.push_back(approximately(execution.output(static_cast<Index>(i), n)));
        }
        return all;
      };
      const Vector<double> near = scene.q0.unaryExpr([](const Mpfr& x) { return approximately(x); });
      const std::vector<double> exact = outputs(term, scene.q0), found = outputs(rounded, near);
      ASSERT_EQ(found.size(), exact.size());
      double size = 0;
      for (const double x : exact) size = std::max(size, std::abs(x));
      for (std::size_t i = 0; i < exact.size(); ++i)
        EXPECT_NEAR(found[i], exact[i], 256 * epsilon<double>() * size) << name << ", " << term.kind << ", " << i;
    }
  }
}

}  // namespace
}  // namespace hbvm::core

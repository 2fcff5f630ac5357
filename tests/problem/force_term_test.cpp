#include "problem/force_term.hpp"

#include "printing.hpp"
#include "problem/work_scene.hpp"

namespace hbvm::core {
namespace {

class ForceTermTest : public InDigits<40> {};

TEST_F(ForceTermTest, InDoubleHasTheSameForce) {
  const Assembled<Mpfr> scene = assemble<Mpfr>(scene_with_work());
  Vector<Mpfr> v = Vector<Mpfr>::Constant(scene.problem.m(), Mpfr(3) / 4);
  for (const ForceTerm<Mpfr>& term : scene.problem.forces) {
    const ForceTerm<double> rounded = in_double(term);
    EXPECT_EQ(rounded.account, term.account);
    ForceInputs<Mpfr> inputs(term, 2, 1);
    ForceInputs<double> inputs_in_double(rounded, 2, 1);
    inputs.update(lanes(scene.q0), lanes(std::as_const(v)));
    inputs_in_double.update(lanes(in_double(scene.q0)), lanes(in_double(v)));
    const Matrix<Mpfr> F = outputs_of(term.force, term.force_coefficients, inputs.values());
    const Matrix<double> G = outputs_of(rounded.force, rounded.force_coefficients, inputs_in_double.values());
    for (Index i = 0; i < F.size(); ++i)
      EXPECT_NEAR(approximately(F.data()[i]), G.data()[i], 16 * epsilon<double>()) << term.name;
  }
}

}  // namespace
}  // namespace hbvm::core

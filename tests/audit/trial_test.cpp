#include "audit/trial.hpp"

#include "audit/claim_groups.hpp"
#include "printing.hpp"
#include "step/hbvm_stepper.hpp"

namespace hbvm::core {
namespace {

class TrialTest : public InDigits<40> {
 protected:
  ClaimGroup group = group_of("double_pendulum", {4, 2}, {Quantity::q});
  Laboratory laboratory{group};
  const Laboratory::Start& start = laboratory.starts().front();
  const Mpfr h = Mpfr(1) / 32;
};

/// In double its steps are those of the stepper in double, and what it hands out is exact.
TEST_F(TrialTest, StepsInItsOwnPrecision) {
  const Assembled<double> scene = assemble<double>(load_scene("double_pendulum"));
  const Hbvm<double> method = make_hbvm<double>(4, 2);
  HbvmStepper<double> stepper(scene.problem, method, SolverKind::newton);
  const auto rounded = [](const Vector<Mpfr>& x) {
    Vector<double> result(x.size());
    for (Index i = 0; i < x.size(); ++i) result[i] = approximately(x[i]);
    return result;
  };
  State<double> state(rounded(start.q), rounded(start.p));
  Trial<double> trial(group.subject());
  trial.begin(start, h);
  Vector<Mpfr> q = start.q, p = start.p, lambda(laboratory.problem().nu());
  for (int n = 0; n < 3; ++n) {
    const StepResult<double> step = stepper.step(state, 1 / double{32});
    EXPECT_EQ(trial.step(), step.sweeps);
    trial.state(q, p);
    trial.multiplier(lambda);
    for (Index i = 0; i < q.size(); ++i) {
      EXPECT_EQ(q[i], Mpfr(state.q[i]));
      EXPECT_EQ(p[i], Mpfr(state.p[i]));
    }
    for (Index a = 0; a < lambda.size(); ++a) EXPECT_EQ(lambda[a], Mpfr((*step.multiplier)[a]));
  }
}

TEST_F(TrialTest, GoesBackToItsStart) {
  Trial<Quad> trial(group.subject());
  trial.begin(start, h);
  for (int n = 0; n < 4; ++n) trial.step();
  trial.reverse();
  for (int n = 0; n < 4; ++n) trial.step();
  Vector<Mpfr> q = start.q, p = start.p;
  trial.state(q, p);
  EXPECT_LE(max_norm(Vector<Mpfr>(q - start.q)), 4000 * Mpfr(epsilon<Quad>()));
  EXPECT_LE(max_norm(Vector<Mpfr>(p + start.p)), 4000 * Mpfr(epsilon<Quad>()));
}

/// u goes from q0 to q1 and v from p0 to p1, and the multipliers at the nodes are nearly those of the states there.
TEST_F(TrialTest, HasThePolynomialsOfItsStep) {
  Trial<Quad> trial(group.subject());
  trial.begin(start, h);
  trial.step();
  ASSERT_TRUE(trial.has_polynomials());
  Vector<Mpfr> q = start.q, p = start.p, u = q, v = p;
  trial.state(q, p);
  const StepPolynomials step = polynomials(trial, start.q, p, h, 2);
  const Mpfr small = 4000 * Mpfr(epsilon<Quad>());
  step.at(laboratory.problem(), Mpfr(0), u, v);
  EXPECT_LE(max_norm(Vector<Mpfr>(u - start.q)), small);
  EXPECT_LE(max_norm(Vector<Mpfr>(v - start.p)), small);
  step.at(laboratory.problem(), Mpfr(1), u, v);
  EXPECT_LE(max_norm(Vector<Mpfr>(u - q)), small);
  EXPECT_LE(max_norm(Vector<Mpfr>(v - p)), small);
  const Mpfr coarse = delta_lambda(laboratory, trial, start.q, p, h, 2);
  trial.begin(start, Mpfr(h / 2));
  trial.step();
  trial.state(q, p);
  const Mpfr fine = delta_lambda(laboratory, trial, start.q, p, Mpfr(h / 2), 2);
  EXPECT_GT(fine, 0);
  EXPECT_GT(coarse, 3 * fine) << "of order s = 2";
  EXPECT_LT(coarse, 5 * fine);
}

}  // namespace
}  // namespace hbvm::core

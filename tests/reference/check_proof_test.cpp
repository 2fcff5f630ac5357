#include "reference/check_proof.hpp"

#include "hbvm/error.hpp"
#include "printing.hpp"
#include "reference/kept_proof.hpp"
#include "words.hpp"

namespace hbvm::core {
namespace {

Reference check(const ProofFile& file) {
  return check_proof(file, [](double) {});
}

/// Why a proof with this change does not hold.
template <class Change>
std::string refusal(ProofFile file, Change change) {
  change(file);
  try {
    check(file);
  } catch (const IntegrationError& error) {
    return error.what();
  }
  return "it holds";
}

RealBall times(const RealBall& x, double factor) {
  const BallScope bits(64);
  return greatest_magnitude(x * exact_ball(factor));
}

TEST(CheckProof, HoldsWhatWasProved) {
  for (const char* name : {"simple_pendulum", "double_pendulum", "kepler", "bead_on_helix", "four_bar_linkage"}) {
    const ProofFile file = proof_of(name);
    const Reference found = check(file);
    EXPECT_EQ(differences(file.claim.reference, found).size(), 0u) << name;
    EXPECT_EQ(found.proved, 12);
    EXPECT_EQ(found.q_names, file.claim.reference.q_names);
    // And as a file.
    const Reference read = check(read_proof(to_text(file), "x.proof"));
    EXPECT_EQ(to_toml({read, "1", "2026-01-01"}), to_toml(file.claim)) << name;
  }
}

TEST(CheckProof, EachStepIsNeeded) {
  const ProofFile file = proof_of("double_pendulum");
  ASSERT_GT(file.proof.steps.size(), 4u);
  expect_words(refusal(file, [](ProofFile& f) { f.proof.steps.erase(f.proof.steps.begin() + 2); }),
               {"step 3", "begins farther away than it says"});
  expect_words(refusal(file, [](ProofFile& f) { f.proof.steps.pop_back(); }), {"ends before t = 2"});
  expect_words(refusal(file, [](ProofFile& f) { f.proof.steps.erase(f.proof.steps.begin()); }),
               {"step 1", "begins farther away"});
}

/// A proof with any number made more favourable is none.
TEST(CheckProof, NothingIsBelieved) {
  const ProofFile file = proof_of("double_pendulum");
  const auto of_step = [&](auto change) { return refusal(file, [&](ProofFile& f) { change(f.proof.steps[1]); }); };
  expect_words(of_step([](ProvedStep& s) { s.before.length = times(s.before.length, 0.5); }), {"step 2", "begins"});
  expect_words(of_step([](ProvedStep& s) { s.after.length = times(s.after.length, 0.9); }), {"step 2", "ends farther"});
  expect_words(of_step([](ProvedStep& s) { s.tube.length = s.before.length; }), {"step 2", "leave the tube"});
  expect_words(of_step([](ProvedStep& s) { s.tube.length = exact_ball(100); }), {"step 2"});
  expect_words(of_step([](ProvedStep& s) { s.tube.omega *= 2; }), {"step 2", "another rate"});
  expect_words(of_step([](ProvedStep& s) { s.pieces.pop_back(); }), {"step 2", "last piece"});
  expect_words(of_step([](ProvedStep& s) { std::swap(s.pieces[0], s.pieces[1]); }), {"step 2", "follow"});
  expect_words(of_step([](ProvedStep& s) { s.pieces[0].omega = -1; }), {"step 2", "follow"});
  expect_words(of_step([](ProvedStep& s) { s.before.length = exact_ball(std::nan("")); }), {"step 2", "no bound"});
}

/// A coefficient that is off by a thousandth of the bounds' size makes the step's defect greater than they allow.
TEST(CheckProof, SeesACoefficientThatIsOff) {
  const ProofFile file = proof_of("simple_pendulum");
  const auto with = [&](bool of_q, Index n) {
    return refusal(file, [&](ProofFile& f) {
      ProvedStep& step = f.proof.steps[1];
      const BallScope bits(400);
      std::vector<BallSeries> q = step.series.q(), lambda = step.series.lambda();
      BallSeries& series = of_q ? q[0] : lambda[0];
      series.set(n, series[n] + exact_ball(1e-20));
      step.series = {q, lambda, step.series.unit(), step.series.end(), step.series.order()};
    });
  };
  expect_words(with(true, 0), {"step 2", "begins"});
  expect_words(with(true, 3), {"step"});
  expect_words(with(false, 5), {"step 2"});
}

/// The digits that are said to be proved are compared with those that are.
TEST(CheckProof, ComparesEveryDigitOfItsClaim) {
  const ProofFile file = proof_of("simple_pendulum");
  const auto of_state = [&](auto change) {
    return refusal(file, [&](ProofFile& f) { change(f.claim.reference.times[1]); });
  };
  const auto last_digit = [](std::string& text) { text.back() = text.back() == '5' ? '6' : '5'; };
  expect_words(of_state([&](ReferenceState& s) { last_digit(s.q[1]); }), {"at t = 2", "q_2"});
  expect_words(of_state([&](ReferenceState& s) { last_digit(s.p[0]); }), {"at t = 2", "p_1"});
  expect_words(of_state([&](ReferenceState& s) { last_digit(s.lambda[0]); }), {"at t = 2", "lambda"});
  expect_words(of_state([&](ReferenceState& s) { s.radius->q = "1e-60"; }), {"q is within 1e-60"});
  expect_words(of_state([&](ReferenceState& s) { s.radius->H = "1e-60"; }), {"H is within 1e-60"});
  EXPECT_THROW(check([&] {
                 ProofFile other = file;
                 other.proof.scene = replaced(other.proof.scene, "mass", "mass = 2 #");
                 return other;
               }()),
               InputError);
}

}  // namespace
}  // namespace hbvm::core

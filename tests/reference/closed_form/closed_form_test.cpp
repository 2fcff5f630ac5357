#include "reference/closed_form/closed_form.hpp"

#include "printing.hpp"
#include "reference/known_motion.hpp"
#include "reference/store.hpp"
#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

/// Every number of the shipped references that a closed form knows, which two other routes found, to its last digit.
TEST(ClosedForms, AgreeWithShippedReferences) {
  std::set<std::string> scenes;
  for (const auto& shipped : shipped_references()) {
    const std::string& name = shipped.first;
    const StoredReference stored = read_reference(shipped.second, name);
    const Reference& reference = stored.reference;
    const PrecisionScope scope(static_cast<unsigned>(reference.digits) + 20);
    const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene(reference.scene));
    const std::unique_ptr<ClosedForm> motion = closed_form_of(scene);
    if (!motion) continue;
    scenes.insert(reference.scene);
    for (const ReferenceState& state : reference.times) {
      const ExactPoint exact = motion->at(literal<Mpfr>(state.t));
      const auto compare = [&](const char* what, const std::vector<std::string>& texts, const Vector<Mpfr>& values) {
        ASSERT_EQ(texts.size(), static_cast<std::size_t>(values.size())) << name;
        // One half of the last digit that is stored, and what rounding to it leaves.
        const Mpfr unit = max_norm(values) * pow(Mpfr(10), -reference.digits);
        for (std::size_t j = 0; j < texts.size(); ++j)
          EXPECT_LE(magnitude(Mpfr(literal<Mpfr>(texts[j]) - values[static_cast<Index>(j)])), unit * 501 / 1000)
              << name << ", t = " << state.t << ": " << what << "_" << j + 1;
      };
      compare("q", state.q, exact.q);
      compare("p", state.p, exact.p);
      compare("lambda", state.lambda, exact.lambda);
    }
  }
  EXPECT_EQ(scenes, (std::set<std::string>{"simple_pendulum", "conical_pendulum", "swinging_pendulum",
                                           "spherical_pendulum", "kepler", "free_rigid_body", "heavy_top_150"}));
}

}  // namespace
}  // namespace hbvm::core

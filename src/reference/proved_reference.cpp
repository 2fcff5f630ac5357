#include "reference/proved_reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "clock.hpp"
#include "reference/growth_survey.hpp"
#include "reference/proof_file.hpp"
#include "reference/proved_motion.hpp"
#include "reference/proved_states.hpp"
#include "scalar/literal.hpp"
#include "scene/moving_point.hpp"

namespace hbvm::core {
namespace {

/// \throws InputError for a start that is not exact
ProvedStates prove(const ReferenceRequest& request, const GrowthSurvey& survey,
                   const std::function<void(double)>& progress) {
  const double before = thread_seconds();
  const Constants& constants = request.scene.constants;
  const Assembled<Mpfr> exact = assembled_for_proof(request.scene);
  ProvedStates proof(request.scene);
  const Mpfr last = evaluate<Mpfr>(request.times.back(), constants);
  double done = 0;
  ProvedMotion motion(
      exact, proof.scene, last, [&](double t) { return survey.omega_at(t); }, [&] { progress(done); });
  if (request.proof != nullptr) {
    *request.proof = {write_scene(request.scene), static_cast<unsigned>(digits10<Mpfr>()), {}};
    motion.keep = [&](const ProvedStep& step) { request.proof->steps.push_back(step); };
  }
  for (const Expression& time : request.times)
    proof.add(motion.at(time_for_proof(time, constants), [&](double now) { done = now / approximately(last); }));
  if (motion.keep) motion.keep(motion.step());
  proof.run.run.settings =
      fmt::format("order {}, {} steps, {} digits, errors bounded to grow by 10^{:.1f}", motion.order(), motion.steps(),
                  digits10<Mpfr>(), motion.growth() / std::numbers::ln10);
  proof.run.run.cpu_seconds = thread_seconds() - before;
  return proof;
}

/// Digits to begin with.
double first_digits(const ReferenceRequest& request, const GrowthSurvey& survey) {
  constexpr int guard = 14;
  return request.digits + std::ceil(survey.growth + std::log10(survey.steps + 1)) + guard;
}

constexpr double most_digits = 50'000;

}  // namespace

Effort proof_effort(const ReferenceRequest& request, const MotionNature& nature) {
  const GrowthSurvey survey = survey_growth(request.scene, request.times.back(), [&](double) {
    if (request.progress) request.progress(0);
  });
  const double digits = first_digits(request, survey);
  if (!(digits < most_digits)) return {"proof", std::numeric_limits<double>::infinity(), 0};
  const PrecisionScope scope(static_cast<unsigned>(digits));
  return effort_of_proof(assemble<Mpfr>(request.scene).problem, nature, static_cast<unsigned>(digits));
}

void add_proved_states(Reference& reference, const ReferenceRequest& request) {
  if (names_work(request.scene))
    throw InputError("'" + request.scene.name +
                     "': digits are proved of forces with a potential that does not depend on t, and of points at "
                     "rest; without --prove two routes are compared");
  constexpr double part_of_survey = double{1} / 10;
  const auto progress = [&](double part) {
    if (request.progress) request.progress(std::min(double{1}, part));
  };
  const GrowthSurvey survey =
      survey_growth(request.scene, request.times.back(), [&](double part) { progress(part_of_survey * part); });
  constexpr int attempts = 6;
  double digits = first_digits(request, survey);
  for (int attempt = 1;; ++attempt) {
    if (!(digits < most_digits) && !request.force)
      throw InputError(
          fmt::format("bounds of errors grow by a factor of 10^{:.0f} until t = {}: a proof takes {:.0f} "
                      "digits; ask for a shorter time, or say --force",
                      survey.growth, request.times.back().text(), digits));
    const PrecisionScope scope(static_cast<unsigned>(digits));
    try {
      const ProvedStates proof =
          prove(request, survey, [&](double part) { progress(part_of_survey + (1 - part_of_survey) * part); });
      // What is conserved has the digits of the start, too.
      const Agreement agreement(proof.scene, request.times, {proof.run}, request.digits);
      double missing = proof.missing_digits(request.digits);
      if (!agreement.holds()) missing = std::max(missing, static_cast<double>(request.digits + 1 - agreement.digits()));
      if (missing <= 0) return proof.write(reference, request, agreement);
      if (attempt == attempts) {
        agreement.require();
        throw IntegrationError(fmt::format("with {:.0f} digits, {:.0f} are missing to prove {}", digits,
                                           std::ceil(missing), request.digits));
      }
      digits += std::ceil(missing) + 2;
    } catch (const BoundsTooWide&) {
      if (attempt == attempts) throw;
      digits += std::ceil(digits / 2);
    }
  }
}

}  // namespace hbvm::core

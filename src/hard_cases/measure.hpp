#pragma once

#include <functional>

#include "hard_cases/case.hpp"
#include "motion.hpp"
#include "run/scene_run.hpp"

namespace hbvm::core {

/// What the body returns; of a run that ended with a typed error, its cause and message. "refused" is an InputError,
/// "integration_error" one without a cause.
CaseResult guarded(const std::function<CaseResult()>& body);

/// What a run says against itself, by the names of its warnings.
std::vector<std::string> warnings_of(const Run& run);

/// A request by its texts.
RunRequest request_of(Scene scene, std::string_view method, std::string_view solver, std::string_view step,
                      std::string_view until, std::string_view precision);

/// Each coordinate, at eight times, against a run in 20 more digits by another solver. The criterion is the greatest
///
///     |x_i - X_i| / (epsilon scale_i + |Y_i - X_i|),
///
/// scale_i is the greatest of what x_i is a sum of, over the run. Y is a run like X that is put off at the start and at
/// every eighth of the run. Each coordinate, constraint and hidden constraint is put off by an ulp of the working
/// precision. That is the problem's own condition and growth. Its bound is that of a few roundings a step, of either
/// sign.
CaseResult accuracy(const RunRequest& request);

/// The worst coordinate of a run against the same run in more digits, and one there that was kicked: see accuracy.
CaseResult compared(const RunRequest& request, const SampledMotion& motion, const SampledMotion& exact,
                    const SampledMotion& kicked);

/// The start, after as many steps back as forth, likewise.
CaseResult reversal(const RunRequest& request);

/// The energy's greatest change over the run, in units of epsilon times the size of its terms. Then the warnings that
/// the run gives of itself. The number of nodes may be the program's choice.
CaseResult energy(const RunRequest& request);

}  // namespace hbvm::core

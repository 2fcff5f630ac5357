#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "audit/convergence.hpp"
#include "run/run_request.hpp"
#include "step/registry.hpp"

namespace hbvm::core {

/// What is measured of the end: positions, and momenta and multipliers of the output state or the propagated ones.
enum class EndPart { q, p, lambda };
inline constexpr std::array<EndPart, 3> end_parts{EndPart::q, EndPart::p, EndPart::lambda};
inline constexpr std::array<const char*, 3> end_part_names{"q", "p", "lambda"};

struct ConvergenceWork {
  RunRequest request;  ///< method, step and precision are those of the lists
  std::vector<NamedMethod> methods;
  std::vector<Precision> precisions;
  std::vector<Expression> steps;                  ///< from coarse to fine
  bool propagated = false;                        ///< p and lambda as they are carried on, not the output state's
  std::function<void(long, long)> progress = {};  ///< with steps of all runs
};

/// One run of a ladder: its step, and the greatest error of each part as text; empty without constraints.
struct ConvergenceStep {
  std::string step;
  std::array<std::string, 3> errors;
};

/// A method's errors against the step in one precision.
struct MeasuredConvergence {
  std::string method, resolved;  ///< as it was asked for, and what that is
  std::string precision;
  std::vector<ConvergenceStep> steps;  ///< that came to the end
  std::array<std::vector<Rung>, 3> rungs;
  std::array<std::optional<Rate>, 3> rates;  ///< none where too few errors are above round-off
  std::string failure;                       ///< of the first step that could not be made
};

/// Errors at the end against the exact motion, which is found once by its Taylor series with 16 more digits than the
/// greatest precision. What rounding explains is measured: the finest run is repeated with 16 more digits.
/// \throws InputError where there is no such series, with the cause; Interrupted
std::vector<MeasuredConvergence> measure_convergence(const ConvergenceWork& work);

/// A, A/2 ... B of "A:B". \throws InputError unless B is A over a power of 2, and there are five steps at least
std::vector<Expression> halved_steps(const std::string& range, const Constants& constants);
/// The time of sixteen steps: a whole number where it is one.
Expression time_of_sixteen(const Expression& step, const Constants& constants);

}  // namespace hbvm::core

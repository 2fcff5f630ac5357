#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cost/cost_errors.hpp"
#include "run/account.hpp"
#include "scalar/precision.hpp"
#include "step/method.hpp"

namespace hbvm::core {

/// One run of a work-precision study: a method, a precision, and the number of its steps.
struct CostCell {
  MethodPtr method;
  Precision precision;
  long steps = 0;

  /// What no other cell of the same scene and time has.
  std::string key() const { return method->key() + "|" + precision.name() + "|" + std::to_string(steps); }
};

/// The step as a text that is exact, "1/4" for 40 steps to t = 10.
std::string step_text(const Expression& until, long steps);

/// How often a run is made.
struct CostRepetitions {
  int least = 3, most = 15;
  double seconds = double{1} / 10;  ///< more than the least only as long as all took less
  bool account = true;              ///< one more, of some steps, to see where the time goes
};

/// What a cell came to. Times are of the processor.
struct CostMeasurement {
  std::string method;         ///< with its k as chosen
  std::string failure;        ///< why it did not come to its end; then the rest is void
  CostErrors errors;          ///< with the output state: p tangential, lambda of Theorem 1
  CostErrors raw;             ///< of p as propagated, and lambda of (57)
  bool at_reference = false;  ///< an error is what the reference leaves open
  double seconds = 0;         ///< of all steps: the median of the repetitions that count
  double spread = 0;          ///< half of the range of these, of the median
  double calibration = 0;     ///< seconds of the calibration beside them, the median
  int repetitions = 0;        ///< that count
  int disturbed = 0;          ///< and that do not, as the calibration beside them was slower
  double setup_seconds = 0;   ///< coefficients, nodes, a k that is chosen
  long sweeps = 0;
  std::uint64_t evaluations = 0;                           ///< of forces, at nodes
  std::uint64_t operations = 0, operations_in_double = 0;  ///< in the working precision, and beside it
  long bytes = 0;                                          ///< that coefficients and stepper hold
  long account_steps = 0;
  std::vector<AccountLine> account;  ///< of the first so many steps
};

/// Makes the run, compares its end with the reference and measures it. What the steps cannot do is a failure; what the
/// scene or the method cannot is thrown. \throws InputError, Interrupted
CostMeasurement measure_cost(const Scene& scene, const Expression& until, const CostCell& cell, const CostJudge& judge,
                             const CostRepetitions& repetitions = {});

/// As JSON, and back. \throws InputError if it is none
std::string to_result(const CostMeasurement& measurement);
CostMeasurement read_cost_measurement(const std::string& text);

/// What a run does in some of its first steps.
struct CostSample {
  std::string failure;
  long steps = 0;
  double seconds = 0;     ///< a step
  double operations = 0;  ///< a step, in the working precision
  double operations_in_double = 0;
};

/// \param most steps, as long as they take less than so many seconds
CostSample sample_cost(const Scene& scene, const Expression& until, const CostCell& cell, long most, double seconds);

}  // namespace hbvm::core

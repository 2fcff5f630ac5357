#pragma once

#include <string>
#include <vector>

#include "integrate/output_state.hpp"
#include "run/run_request.hpp"

namespace hbvm {

/// How far the end of a run is from the exact motion: its difference from a stored reference of this scene and time, if
/// there is one with enough digits; else from the motion by its Taylor series with 16 more digits (of a Taylor series,
/// by HBVM), by steps of its own between whose points it looks; where there is no such series, since a force is not
/// smooth or the start leaves the hidden constraints, from a run with another step, more stages and 16 more digits.
/// Positions, and the momenta and multipliers of the output state.
struct ErrorEstimate {
  std::string reference;                                  ///< "stored reference, 50 digits" or "computed now"
  std::string method, precision;                          ///< of what was made beside; empty if there is none
  std::string q, p, lambda;                               ///< the greatest differences; empty without constraints
  std::vector<double> q_digits, p_digits, lambda_digits;  ///< that are right, of each; at most those of the precision
  std::string failure;  ///< why the run beside did not reach the end, if it did not; nothing else is known
};

/// \param method with the k that was chosen \param start where the run began, if not at the start of its scene
/// \param output_lambda of all constraints
template <Scalar S>
ErrorEstimate estimate_error(const RunRequest& request, const Method& method, const std::optional<State<S>>& start,
                             const Vector<S>& q, const Vector<S>& output_p, const Vector<S>& output_lambda);

/// A decimal with the digits that are right, and one more; of none right, with that one.
std::string to_right_digits(const std::string& number, double right);

/// Lines for people: the greatest errors, or the failure.
std::string to_text(const ErrorEstimate& estimate);

#define HBVM_DECLARE(S)                                                                                             \
  extern template ErrorEstimate estimate_error<S>(const RunRequest&, const Method&, const std::optional<State<S>>&, \
                                                  const Vector<S>&, const Vector<S>&, const Vector<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DECLARE)
#undef HBVM_DECLARE

}  // namespace hbvm

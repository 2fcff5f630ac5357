#pragma once

#include <functional>
#include <vector>

#include "integrate/time_grid.hpp"
#include "run/run_request.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {

/// What one direction of the start grows by: the mean of d(log |change|)/dt, within +- uncertainty.
struct LyapunovExponent {
  double value = 0, uncertainty = 0;
};

/// How the end of a run changes with its start. It is the derivative of its steps, on the manifold of states that
/// fulfil g and the hidden constraints.
struct TangentMap {
  Vector<Mpfr> q, p;           ///< the end, an output state
  Matrix<Mpfr> start, end;     ///< a column a direction, q over p: at the start, and what it has become
  std::vector<double> times;   ///< of the ends of blocks
  std::vector<double> growth;  ///< log10 of the greatest factor of a change until then
  /// Means of the rates of growth of each direction, from the start until each of these times.
  std::vector<std::vector<double>> means;
  std::vector<LyapunovExponent> exponents;  ///< from the greatest on
  Mpfr symplectic_defect;                   ///< by which the end's 2-form differs from the start's, over its size
  double distance = 0;                      ///< log10 of how far the end is from the start, over the sizes of q and p
};

/// Follows a basis of changes by runs from neighbours of the start, in more than twice the digits of the request. The
/// quotients of their distances are the derivatives to as many digits as were asked for. After some steps neighbours
/// are set anew, from the output state, so that changes stay small and independent.
/// \throws InputError for forces without a potential, and unless steps are ten or more; IntegrationError, Interrupted
TangentMap tangent_map(const RunRequest& request, const std::function<void(double)>& progress);

/// d(end)/d(constant) of the output state at the end, q over p. \throws InputError likewise
Vector<Mpfr> constant_sensitivity(const RunRequest& request, const std::string& constant);

/// Digits of numbers that stand for infinitely small changes, and of all that is computed with them.
struct TangentDigits {
  int asked = 0, working = 0;
  static TangentDigits of(const Precision& precision);
};

}  // namespace hbvm::core

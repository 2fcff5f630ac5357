#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "hbvm/scene.hpp"

namespace hbvm {

/// A solution whose digits are found by two routes that share only the scene, and by the closed form where there is
/// one. Or its digits are proved.
struct ReferenceRequest {
  Scene scene;
  Numbers times;            ///< positive, ascending
  int digits = 30;          ///< after the leading one of each vector's greatest component, 1 to 5000
  std::string route = {};   ///< "taylor", "hbvm" or "closed_form" alone: nothing is confirmed then
  bool force = false;       ///< do also what is expected to take more than a day, or 16 GB
  bool prove = false;       ///< by bounds of the motion, step by step, instead of two routes that agree
  bool keep_proof = false;  ///< give out what proves it, too
  std::function<void(double part)> progress = {};  ///< called now and then, from any thread
  std::stop_token stop = {};
};

/// A time at which a value of an event of the scene crosses 0, to four digits more than the request asks for.
struct ReferenceEvent {
  std::string name;
  bool rises = false;  ///< the value is negative before
  Number t;
};

/// How far numbers may be from the motion, as is proved: the most of each vector's components, three digits or fewer.
struct ProvedRadius {
  std::string q, p, lambda, H;
};

/// A decimal text for each number, to `digits` digits after the leading one of its vector's greatest component.
struct ReferenceState {
  std::string t;
  std::vector<std::string> q, p, lambda;  ///< p tangential, lambda of Theorem 1
  std::string H;
  std::vector<std::string> momenta;  ///< those the problem conserves, in the order of their names
  long agreed = 0;  ///< digits after the leading one on which all routes agree, the least of all vectors
  std::vector<std::string> observed = {};   ///< what the scene observes
  std::optional<double> digits_lost = {};   ///< an error of the start has grown by 10^digits_lost; none in a file
  std::optional<ProvedRadius> radius = {};  ///< if the digits are proved: besides their rounding to the last digit
};

struct RouteReport {
  std::string name, settings;
  double cpu_seconds = 0;
};

struct Reference {
  std::string scene, title, scene_hash;
  int digits = 0;
  std::vector<std::string> q_names, p_names, lambda_names;  ///< "a.x", "a.px", the constraint of each multiplier
  std::vector<ReferenceState> times;
  std::vector<std::string> momentum_names, observed_names;
  std::vector<RouteReport> routes;
  double digits_lost = 0;       ///< by which the motion magnifies an error of the start, in decimal digits
  int proved = 0;               ///< digits that are proved; 0 if they are agreed on
  std::string scene_toml = {};  ///< the scene's file
  std::string proof = {};  ///< what proves them, as the text of a file, if it was asked for: check_proof() takes it
};

/// \throws InputError for digits or times out of range, for what would take too long, for a closed form that is not
///         known, and for a proof from a start that is not exact
/// \throws IntegrationError where the motion ends, the routes do not agree, with both values, or nothing can be proved
/// \throws Interrupted
Reference reference(const ReferenceRequest& request);

/// The events of the scene until the last time of the request. Both routes agree on the states in which their values
/// are 0. \throws what reference() throws; IntegrationError if an event grazes 0
std::vector<ReferenceEvent> reference_events(const ReferenceRequest& request);

/// A proof to be gone through again.
struct ProofRequest {
  std::string text;            ///< Reference::proof, or a file that `hbvm reference --prove --out FILE.proof` wrote
  std::string name = "proof";  ///< for messages
  std::function<void(double part)> progress = {};  ///< called now and then, from any thread
  std::stop_token stop = {};
};

/// Checks a proof, each step by itself: that from the bounds at its start those at its end follow, and that steps join.
/// \return the reference that is proved, to the digits of Reference::proved
/// \throws InputError for what is no proof, or was changed
/// \throws IntegrationError with the step that does not hold
/// \throws Interrupted
Reference check_proof(const ProofRequest& request);

/// All numbers for another program, text by text: a line, a row or an array for each time. The names of q, p and
/// multipliers are those of the reference, or else counted.
/// \param language "csv"; "julia" (BigFloat), "python" (mpmath), "fortran" (real(16)) or "c" (any type of numbers)
/// \throws InputError for another
std::string to_literals(const Reference& reference, const std::string& language);

/// One JSON object, as `hbvm reference --json` prints it. \param command that made it, of the program
std::string to_json(const Reference& reference, const std::string& command = {});

}  // namespace hbvm

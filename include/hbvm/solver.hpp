#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "hbvm/number.hpp"
#include "hbvm/scene.hpp"

namespace hbvm {

/// A run that is asked of an integrator of one's own. Numbers are decimals, which are exact in double
/// unless the request says until when.
struct SolverTask {
  Scene scene;
  std::string step, until;
};

/// An integrator of one's own, to be judged by its runs at a ladder of steps.
struct SolverRequest {
  std::string name = "solver";  ///< stands in messages
  /// Its states as CSV: names of columns, then a line a time, the start and the end among them. What it throws is told
  /// of the scene, and others go on.
  std::function<std::string(const SolverTask&)> solve = {};
  /// What its columns are, as ResultsRequest::map has it.
  std::vector<std::pair<std::string, std::string>> map = {};
  std::optional<int> order = {};     ///< that is claimed
  std::vector<Scene> scenes = {};    ///< simple, conical and double pendulum if empty
  std::optional<Number> until = {};  ///< of the ladder; without, some of the times in which each motion changes
  std::function<void(double part)> progress = {};  ///< called now and then, from any thread
  std::stop_token stop = {};
};

/// What is found of one quantity on one scene.
struct SolverVerdict {
  std::string scene = {};
  std::string quantity = {};  ///< "order", "drift" of H or "reversal"
  std::string verdict = {};   ///< of a claim: "holds", "fails", "undecidable"; else "seen"; or "not run"
  std::optional<int> claimed = {};
  /// The order; or the power of the time with which the error of H grows; or right digits after there and back.
  std::optional<double> measured = {}, uncertainty = {};
  std::string reason = {};  ///< in words: "bounded", "symmetric to 14.2 digits", or why there is nothing
};

struct SolverAudit {
  std::string name;
  std::vector<SolverVerdict> verdicts;
  bool holds = false;    ///< every claim
  bool decided = false;  ///< no scene was left out, and no claim is undecidable
};

/// Judges an integrator against references. Its errors at the end of a ladder of steps tell the order, with the audit's
/// judge. A run of 32 times the length tells how the error of H grows. A run back from its own end, with velocities
/// turned round, tells whether it is symmetric. \throws InputError for a request that cannot be met; Interrupted
SolverAudit audit_solver(const SolverRequest& request);

std::string to_text(const SolverAudit& audit);
std::string to_json(const SolverAudit& audit);
/// XML of JUnit, for services that run tests.
std::string to_junit(const SolverAudit& audit);

}  // namespace hbvm

#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "hbvm/scene.hpp"

namespace hbvm {

/// What is the cheapest run with so many right digits?
struct PlanRequest {
  Scene scene;
  Number until;
  int digits = 8;
  std::string quantity = "all";              ///< what must have them; see `hbvm cost --help`
  std::vector<std::string> methods = {};     ///< empty: those the planner knows
  std::vector<std::string> precisions = {};  ///< empty: double and quad where they do, and as many digits as it takes
  std::function<void(double part)> progress = {};  ///< called now and then, from any thread
  std::stop_token stop = {};
};

/// A run with its cost, as a model has it and as it was.
struct PlannedRun {
  std::string method, step, precision;
  long steps = 0;
  double predicted_seconds = 0, predicted_error = 0;  ///< the error as log10 of it
  std::optional<double> seconds = {}, error = {};     ///< measured, if it was run
};

struct Plan {
  PlannedRun pick;
  std::vector<PlannedRun> runners_up;
  int runs = 0;  ///< made to the end to find out
  std::string text, json;
};

/// \throws InputError, IntegrationError if nothing has the digits, Interrupted
Plan plan(const PlanRequest& request);

/// One JSON object, as `hbvm cost --digits --json` prints it.
std::string to_json(const Plan& plan);

}  // namespace hbvm

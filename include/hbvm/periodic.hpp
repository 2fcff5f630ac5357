#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "hbvm/number.hpp"
#include "hbvm/scene.hpp"
#include "hbvm/tangent.hpp"

namespace hbvm {

/// A motion that comes back to its start, found from a start nearby that has the same H.
struct PeriodicRequest {
  Scene scene;
  Number until;                           ///< before which the motion comes back near its start
  std::optional<std::string> plane = {};  ///< a formula of what may be observed that is 0 at the start looked for
  int digits = 30;
  std::function<void(double part)> progress = {};
  std::stop_token stop = {};
};

struct Periodic {
  std::string scene;
  std::vector<std::string> q_names, p_names;
  std::vector<std::string> q, p;  ///< the start, all digits asked for; a component that vanishes is 0
  std::string period, H;
  int digits = 0;
  long agreed = 0;                      ///< digits in which two routes agree
  int iterations = 0;                   ///< of Newton's method
  std::vector<Multiplier> multipliers;  ///< from the greatest on
  bool stable = false;                  ///< no multiplier is off the unit circle by more than a millionth
  std::string command;
};

/// Newton's method for a start x and a period T: x(T) = x, H(x) = H_0, and the plane is 0. Without a plane, the start
/// moves across the motion. \throws InputError for forces without a potential; Interrupted
/// \throws IntegrationError if there is no such motion nearby, or two routes do not agree on it
Periodic periodic(const PeriodicRequest& request);

std::string to_text(const Periodic& periodic);
/// One JSON object, which `hbvm run --start` reads, too.
std::string to_json(const Periodic& periodic);

}  // namespace hbvm

#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "hbvm/figure.hpp"
#include "hbvm/horizon.hpp"
#include "hbvm/method.hpp"
#include "hbvm/number.hpp"
#include "hbvm/scene.hpp"

namespace hbvm {

/// How a motion changes with its start. It is followed by steps of the method from neighbours of the start. They are
/// so near that quotients of distances are derivatives, to the digits of the precision.
struct TangentRequest {
  Scene scene;
  std::string method = usual_method;
  std::optional<Number> step = {};  ///< without, one that suits the scene's time scale
  Number until = 1;
  std::string precision = "double";         ///< whose digits derivatives have; what is computed has more than twice
  std::string solver = "auto";              ///< of the stage equations
  std::vector<std::string> constants = {};  ///< of the scene: how the end changes with each, too
  std::function<void(double part)> progress = {};  ///< called now and then
  std::stop_token stop = {};
};

/// A Lyapunov exponent: the mean rate at which the logarithm of a change grows. It lies within value +- uncertainty, as
/// far as eight parts of the time tell, which is no bound.
struct Exponent {
  double value = 0, uncertainty = 0;
};

/// An eigenvalue of the map of a motion that closes: a multiplier of the periodic motion.
struct Multiplier {
  double real = 0, imaginary = 0;
};

struct Tangent {
  std::string scene, title, method, step, until, precision;
  std::vector<std::string> names = {};  ///< of the state: of q, then of p
  std::vector<std::string> end = {};    ///< the output state at the end
  /// Changes of the start that keep to g and the hidden constraints, and what has become of each at the end. Those of
  /// the start are orthonormal over the sizes of q and p. Entries as `names`.
  std::vector<std::vector<std::string>> directions = {}, changes = {};
  std::vector<double> times = {},
                      growth = {};  ///< log10 of the greatest factor of a change until each time: digits lost
  /// Means of the rates of growth from the start until each time, which tend to the exponents. The first ends as the
  /// greatest.
  std::vector<std::vector<double>> means = {};
  std::vector<Exponent> exponents = {};      ///< from the greatest on; they come in pairs that add up to 0
  double symplectic_defect = 0;              ///< log10 of what the 2-form of two changes differs by, over its size
  std::vector<Multiplier> multipliers = {};  ///< if the end is the start, to four digits
  std::vector<Horizon> horizons = {};
  /// d(end)/d(constant), by its name; entries as `names`.
  std::vector<std::pair<std::string, std::vector<std::string>>> sensitivities = {};
  std::string command = {};  ///< of the program, which finds the same
};

/// \throws InputError for forces without a potential, fewer than ten steps, and constants that there are not
/// \throws IntegrationError, Interrupted
Tangent tangent(const TangentRequest& request);

/// How the exponents settle, and digits lost, against time.
Figure figure_of(const Tangent& tangent);
std::string to_text(const Tangent& tangent);
std::string to_json(const Tangent& tangent);

}  // namespace hbvm

#pragma once

#include <string>
#include <vector>

#include "method/hbvm_name.hpp"
#include "run/round_off.hpp"
#include "scalar/precision.hpp"
#include "scene/scene.hpp"

namespace hbvm::core {

/// How a quantity that the motion conserves fared over a run.
struct ConservedQuantity {
  enum class Kind { energy, constraints, linear_momentum, angular_momentum };
  Kind kind;
  std::string name;   ///< of a momentum
  std::string drift;  ///< greatest change over the mesh (of the constraints: greatest value)
  double ulps = 0;    ///< the same over epsilon times the size of the terms it is the sum of
};

struct Conservation {
  HbvmName method;
  long steps = 0;
  std::vector<ConservedQuantity> quantities;  ///< energy, constraints if any, then each momentum

  /// The ulps that round-off explains.
  double round_off() const { return round_off_units(steps); }
};

enum class Nodes {
  s,    ///< k = s, and r = s for constraints that are not quadratic
  more  ///< the k and r of hbvm:auto,S; where k is s, 2 s
};

struct ConservationRequest {
  const Scene* scene = nullptr;
  int s = 0;
  Nodes nodes = Nodes::s;
  Expression step, until;
};

/// \throws InputError, IntegrationError
Conservation conservation(const ConservationRequest& request, const Precision& precision);

}  // namespace hbvm::core

#pragma once

#include <string>
#include <vector>

#include "reference/compute_reference.hpp"

namespace hbvm::core {

/// A time at which a value of an event of the scene crosses 0.
struct EventTime {
  std::string name;
  bool rises = false;
  Expression t;
};

/// The events of the scene until the last time of the request, to more digits than it asks for. They are found by steps
/// of HBVM of high order. Then Newton's method moves each until the value is 0 in the states that both routes agree on.
/// An event that grazes 0 has no such time, and is left out.
/// \throws what compute_reference() throws; IntegrationError if the times do not settle
std::vector<EventTime> event_times(const ReferenceRequest& request);

}  // namespace hbvm::core

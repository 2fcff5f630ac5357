#pragma once

#include "reference/compute_reference.hpp"

namespace hbvm::core {

/// What is asked of a scene at these times.
inline ReferenceRequest request_of(Scene scene, const std::vector<const char*>& times, int digits) {
  ReferenceRequest request;
  request.scene = std::move(scene);
  for (const char* t : times) request.times.push_back(Expression::parse(t));
  request.digits = digits;
  return request;
}
inline ReferenceRequest request_of(const char* scene, const std::vector<const char*>& times, int digits) {
  return request_of(load_scene(scene), times, digits);
}

}  // namespace hbvm::core

#pragma once

#include <string>

#include "clock.hpp"
#include "linear/operation_counts.hpp"
#include "scalar/archive.hpp"

namespace hbvm::core {

/// One part of what a step consists of: how often it ran, what one call costs, and, if measured, the time it took.
struct PartCount {
  std::string name{};
  std::uint64_t calls = 0;
  OperationCounts per_call{};
  double seconds = 0;      ///< elapsed
  bool in_double = false;  ///< its operations are those of double in a step of more digits

  /// Whether calls of both are calls of the same.
  bool is_like(const PartCount& other) const {
    return name == other.name && in_double == other.in_double && per_call == other.per_call;
  }
  void remember(Archive& archive) { archive(name, calls, per_call, seconds, in_double); }
};

/// Counts a call of a part and times it.
class PartCall {
 public:
  [[gnu::always_inline]] explicit PartCall(PartCount& part) : timer_(part.seconds) { ++part.calls; }
  [[gnu::always_inline]] ~PartCall() = default;
  PartCall(const PartCall&) = delete;

 private:
  PartTimer timer_;
};

}  // namespace hbvm::core

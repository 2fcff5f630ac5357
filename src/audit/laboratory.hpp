#pragma once

#include <optional>
#include <vector>

#include "claim_group.hpp"
#include "problem/state_evaluator.hpp"
#include "reference/closed_form/closed_form.hpp"
#include "scene/assemble.hpp"

namespace hbvm::core {

/// Decimal digits that everything measured has beyond those under audit.
inline constexpr unsigned guard_digits = 24;

/// A problem and generic consistent states of it, in the digits of the scope.
class Laboratory {
 public:
  struct Start {
    Vector<Mpfr> q, p;
  };

  /// With the starts of a group.
  /// \throws InputError, IntegrationError, StageFailure
  explicit Laboratory(const ClaimGroup& group);

  const Problem<Mpfr>& problem() const { return assembled_.problem; }
  const std::vector<Start>& starts() const { return starts_; }
  StateEvaluator<Mpfr>& point() { return *point_; }
  /// The motion from a start after the time t, if it is known in closed form.
  std::optional<ExactPoint> known(const Start& start, const Mpfr& t) const;

 private:
  void walk(const ClaimGroup& group);

  Assembled<Mpfr> assembled_;
  std::vector<Start> starts_;
  std::optional<StateEvaluator<Mpfr>> point_;
};

}  // namespace hbvm::core

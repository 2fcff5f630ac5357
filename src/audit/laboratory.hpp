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
  /// The distance of two positions, or of two momenta, of the bodies: driven coordinates are not looked at.
  Mpfr apart(const Vector<Mpfr>& a, const Vector<Mpfr>& b) const;
  /// The motion from a start after the time t, if it is known in closed form.
  std::optional<ExactPoint> known(const Start& start, const Mpfr& t) const;

 private:
  /// Puts a start where the group wants one after so many of its steps. \return whether there are enough
  bool take(const Vector<Mpfr>& q, const Vector<Mpfr>& p, long steps, const Starts& wanted);
  void walk(const ClaimGroup& group);

  Assembled<Mpfr> assembled_;
  std::vector<Start> starts_;
  std::optional<StateEvaluator<Mpfr>> point_;
};

}  // namespace hbvm::core

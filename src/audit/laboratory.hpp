#pragma once

#include <optional>
#include <vector>

#include "cell.hpp"
#include "problem/point.hpp"
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

  /// With the starts of a cell.
  /// \throws InputError, IntegrationError, StageFailure
  explicit Laboratory(const Cell& cell);

  const Problem<Mpfr>& problem() const { return assembled_.problem; }
  const std::vector<Start>& starts() const { return starts_; }
  Point<Mpfr>& point() { return *point_; }
  /// The motion from a start after the time t, if it is known in closed form.
  std::optional<ExactPoint> known(const Start& start, const Mpfr& t) const;

 private:
  void walk(const Cell& cell);

  Assembled<Mpfr> assembled_;
  std::vector<Start> starts_;
  std::optional<Point<Mpfr>> point_;
};

}  // namespace hbvm::core

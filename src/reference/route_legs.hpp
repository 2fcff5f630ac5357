#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reference/closed_form/closed_form.hpp"

namespace hbvm::core {

/// Keeps the legs of a long way, JSON under a key. Work that was ended goes on after the last of them. Called by
/// several threads at once.
struct LegKeeper {
  std::function<std::optional<std::string>(const std::string& key)> find;
  std::function<void(const std::string& key, const std::string& json)> keep;
};

/// A part of the way from one state to another, with the states asked for on it.
struct Leg {
  Vector<Mpfr> q, p;  ///< at its end
  std::vector<ExactPoint> points;
  long steps = 0;
  double cpu_seconds = 0;
};

/// Leg after leg, in the digits of the scope or fewer. Each starts from the state alone in which the last has ended:
/// whether that was made now or found again, what follows is the same. \param times asked for, ascending; the last ends
/// the way \param run   the leg of this number, from 0 on. It starts at `begin` with these q, p and ends at `end`;
/// `times` lie
///              between
using RunLeg = std::function<Leg(std::size_t number, const Mpfr& begin, const Mpfr& end, const std::vector<Mpfr>& times,
                                 const Vector<Mpfr>& q, const Vector<Mpfr>& p)>;
/// \return the last leg's end, the points, steps and time of all
Leg run_legs(const Assembled<Mpfr>& scene, const std::vector<Mpfr>& times, long count, const LegKeeper& keeper,
             const RunLeg& run);

}  // namespace hbvm::core

#pragma once

#include <functional>

#include "reference/compute_reference.hpp"

namespace hbvm::core {

/// The state at t > 0 of the motion that is at (q, p) at 0, by one route in the digits of the scope. The route, Taylor
/// series or HBVM, chooses its steps itself, and looks between their points.
/// \param while_working is called now and then, and may throw to end the work
/// \throws IntegrationError where the motion ends or cannot be followed
ExactPoint exact_end(const Problem<Mpfr>& problem, const Vector<Mpfr>& q, const Vector<Mpfr>& p, const Mpfr& t,
                     Route route, const std::function<void()>& while_working);

}  // namespace hbvm::core

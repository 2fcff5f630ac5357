#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "door/door.hpp"
#include "hbvm/periodic.hpp"
#include "long_work/json.hpp"
#include "reference/agreement.hpp"
#include "run/periodic_orbit.hpp"
#include "scalar/text.hpp"
#include "scene/coordinate_names.hpp"
#include "scene/set_number.hpp"

namespace hbvm {
namespace {

/// So many digits of the greatest entry. If that is less than a unit of the last digit of `size`, all are 0.
std::vector<std::string> to_digits(const core::Vector<core::Mpfr>& x, const core::Mpfr& size, int digits) {
  const core::Mpfr greatest = core::max_norm(x);
  const long of_size = core::decimal_exponent(size),
             leading = greatest == 0 ? of_size : core::decimal_exponent(greatest);
  std::vector<std::string> texts;
  for (const core::Mpfr& entry : x)
    texts.push_back(core::to_digit(entry, (leading < of_size - digits ? of_size : leading) + 1 - digits));
  return texts;
}

}  // namespace

Periodic periodic(const PeriodicRequest& asked) {
  const core::Admitted admitted(asked.stop);
  constexpr int most = 1000;
  if (asked.digits < 1 || asked.digits > most)
    throw InputError(fmt::format("a periodic motion has 1 to {} digits, not {}", most, asked.digits));
  core::PeriodicRequest request{.scene = core::scene_of(asked.scene),
                                .until = core::expression_of(asked.until, "until")};
  request.digits = asked.digits;
  request.progress = asked.progress;
  if (asked.plane) try {
      request.plane = core::Expression::parse(*asked.plane, core::Expression::Syntax::observation);
    } catch (const core::ExpressionError& error) {
      throw InputError("the plane '" + *asked.plane + "': " + error.what());
    }
  const core::PeriodicOrbit orbit = core::periodic_orbit(request);
  Periodic found{.scene = request.scene.name,
                 .q_names = core::coordinate_names(request.scene),
                 .p_names = core::coordinate_names(request.scene, "p"),
                 .q = to_digits(orbit.start.q, orbit.q_size, asked.digits),
                 .p = to_digits(orbit.start.p, orbit.p_size, asked.digits),
                 .period = core::rounded_text(core::to_text(orbit.period), asked.digits),
                 .H = core::to_digit(orbit.H, core::decimal_exponent(orbit.H_size) + 1 - asked.digits),
                 .digits = asked.digits,
                 .agreed = orbit.agreed,
                 .iterations = orbit.iterations,
                 .multipliers = {},
                 .stable = true,
                 .command = {}};
  constexpr double millionth = 1 / double{1'000'000};
  for (const std::complex<double>& multiplier : orbit.multipliers) {
    found.multipliers.push_back({multiplier.real(), multiplier.imag()});
    found.stable = found.stable && std::abs(multiplier) < 1 + millionth;
  }
  found.command = "hbvm periodic " + request.scene.name + core::settings_in_command(request.scene) +
                  (asked.plane ? " --plane '" + *asked.plane + "'" : "") + " --until '" + request.until.text() +
                  "' --digits " + std::to_string(asked.digits);
  return found;
}

std::string to_text(const Periodic& periodic) {
  std::string text = fmt::format(
      "{}: a motion that comes back after\n\n  T = {}\n\n{} digits; two routes agree in {}; "
      "{} iterations\nH = {}\n\nstart\n",
      periodic.scene, periodic.period, periodic.digits, periodic.agreed, periodic.iterations, periodic.H);
  for (std::size_t n = 0; n < periodic.q.size(); ++n)
    text += fmt::format("  {:<12} {}\n", periodic.q_names[n], periodic.q[n]);
  for (std::size_t n = 0; n < periodic.p.size(); ++n)
    text += fmt::format("  {:<12} {}\n", periodic.p_names[n], periodic.p[n]);
  text += "\nmultipliers\n";
  for (const Multiplier& multiplier : periodic.multipliers)
    text += fmt::format("  {:+.9g} {:+.9g} i\n", multiplier.real, multiplier.imaginary);
  return text + (periodic.stable
                     ? "none is off the unit circle: changes of the start grow by a power of the time at most\n"
                     : "one is beyond the unit circle: changes of the start grow exponentially\n");
}

std::string to_json(const Periodic& periodic) {
  core::OrderedJson j{{"scene", periodic.scene},
                      {"names", {{"q", periodic.q_names}, {"p", periodic.p_names}}},
                      {"q", periodic.q},
                      {"p", periodic.p},
                      {"period", periodic.period},
                      {"H", periodic.H},
                      {"digits", periodic.digits},
                      {"agreed", periodic.agreed},
                      {"iterations", periodic.iterations}};
  j["multipliers"] = core::OrderedJson::array();
  for (const Multiplier& multiplier : periodic.multipliers)
    j["multipliers"].push_back({multiplier.real, multiplier.imaginary});
  j["stable"] = periodic.stable;
  j["command"] = periodic.command;
  return core::dumped(j, 2);
}

}  // namespace hbvm

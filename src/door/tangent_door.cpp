#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "door/door.hpp"
#include "door/horizon_text.hpp"
#include "door/run_of.hpp"
#include "hbvm/tangent.hpp"
#include "hbvm/version.hpp"
#include "long_work/json.hpp"
#include "run/horizon.hpp"
#include "run/tangent_map.hpp"
#include "run/tangent_space.hpp"
#include "scalar/log2_of.hpp"
#include "scalar/text.hpp"
#include "scene/coordinate_names.hpp"
#include "scene/set_number.hpp"

namespace hbvm {
namespace {

using core::Index;
using core::Mpfr;

std::vector<std::string> texts_of(const core::Vector<Mpfr>& x, int digits) {
  std::vector<std::string> texts;
  for (Index i = 0; i < x.size(); ++i) texts.push_back(core::to_scientific(x[i], digits));
  return texts;
}

}  // namespace

Tangent tangent(const TangentRequest& door) {
  const core::Admitted admitted(door.stop);
  RunRequest asked{.scene = door.scene, .method = door.method, .step = door.step, .until = door.until};
  asked.precision = door.precision;
  asked.solver = door.solver;
  const core::RunRequest request = core::request_of(asked, {});
  for (const std::string& constant : door.constants)
    if (!request.scene.constants.contains(constant))
      throw InputError("the scene has no constant '" + constant + "' to change");
  const core::TangentMap map = core::tangent_map(request, core::watched(door.progress));
  const core::TangentDigits digits = core::TangentDigits::of(request.precision);
  const core::PrecisionScope scope(static_cast<unsigned>(digits.working));
  Tangent found{.scene = request.scene.name,
                .title = request.scene.title,
                .method = request.method->text(),
                .step = request.step.text(),
                .until = request.until.text(),
                .precision = request.precision.name()};
  found.names = core::coordinate_names(request.scene);
  for (const std::string& name : core::coordinate_names(request.scene, "p")) found.names.push_back(name);
  for (const core::Vector<Mpfr>& part : {map.q, map.p})
    for (const std::string& text : texts_of(part, digits.asked)) found.end.push_back(text);
  for (Index j = 0; j < map.start.cols(); ++j) {
    found.directions.push_back(texts_of(map.start.col(j), digits.asked));
    found.changes.push_back(texts_of(map.end.col(j), digits.asked));
  }
  found.times = map.times;
  found.growth = map.growth;
  found.command = "hbvm tangent " + request.scene.name + core::settings_in_command(request.scene) + " --method " +
                  found.method + " --step '" + found.step + "' --until '" + found.until + "' --precision " +
                  found.precision;
  // In the order of the exponents: rates of directions settle in no order of their own.
  std::vector<std::size_t> order(map.exponents.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return map.means.back()[a] > map.means.back()[b]; });
  for (const std::vector<double>& means : map.means) {
    std::vector<double>& sorted = found.means.emplace_back();
    for (const std::size_t i : order) sorted.push_back(means[i]);
  }
  for (const core::LyapunovExponent& exponent : map.exponents)
    found.exponents.push_back({exponent.value, exponent.uncertainty});
  found.symplectic_defect = core::log10_of(map.symplectic_defect);
  constexpr double closed = -4;
  if (map.distance < closed)
    for (const std::complex<double>& multiplier : core::multipliers_of(map.start, map.end))
      found.multipliers.push_back({multiplier.real(), multiplier.imag()});
  const Exponent& greatest = found.exponents.front();
  const double rate = greatest.value > greatest.uncertainty ? greatest.value / std::log(double{10}) : 0;
  for (const char* const name : {"double", "mpfr:34", "mpfr:50", "mpfr:100"})
    found.horizons.push_back(
        core::horizon_of(name, core::Precision::parse(name).digits(), found.times, found.growth, rate));
  for (const std::string& constant : door.constants)
    found.sensitivities.emplace_back(constant, texts_of(core::constant_sensitivity(request, constant), digits.asked));
  return found;
}

Figure figure_of(const Tangent& tangent) {
  Panel exponents, lost;
  exponents.title = "Mean rates of growth until t";
  exponents.x.label = lost.x.label = "t";
  exponents.y.label = "exponent";
  const std::size_t shown = std::min(tangent.exponents.size(), curve_colours.size());
  for (std::size_t i = 0; i < shown; ++i) {
    Curve& curve = exponents.curves.emplace_back();
    for (std::size_t n = 0; n < tangent.times.size(); ++n)
      curve.points.push_back({tangent.times[n], tangent.means[n][i]});
    // The first tenth of the time is left out: means over so short a time are large and say little.
    constexpr std::size_t settled = 10;
    curve.points.erase(curve.points.begin(),
                       curve.points.begin() + static_cast<std::ptrdiff_t>(curve.points.size() / settled));
  }
  lost.title = "Digits lost";
  lost.y.label = "digits";
  Curve& curve = lost.curves.emplace_back();
  for (std::size_t n = 0; n < tangent.times.size(); ++n) curve.points.push_back({tangent.times[n], tangent.growth[n]});
  Figure figure;
  figure.caption = plain(tangent.title);
  figure.footnote = std::string("hbvm ") + version() + ": " + tangent.command;
  figure.panels = {std::move(exponents), std::move(lost)};
  return figure;
}

std::string to_text(const Tangent& tangent) {
  std::string text = fmt::format("{}: {}, steps of {} to t = {}, derivatives to the digits of {}\n", tangent.scene,
                                 tangent.method, tangent.step, tangent.until, tangent.precision);
  text += "\nLyapunov exponents, within what eight parts of the time tell\n";
  double sum = 0;
  for (const Exponent& exponent : tangent.exponents) {
    text += fmt::format("  {:+.6f} +- {:.6f}\n", exponent.value, exponent.uncertainty);
    sum += exponent.value;
  }
  text += fmt::format("  their sum is {:.1e}\n", sum);
  text += fmt::format("\na change of the start grows by up to 10^{:.1f}: so many digits are lost until then\n",
                      tangent.growth.back());
  for (const Horizon& horizon : tangent.horizons)
    text += core::line_of(horizon, ": no exponent is above its uncertainty");
  text += fmt::format("the 2-form of two changes is kept to {:.0f} digits\n",
                      std::max(double{0}, -tangent.symplectic_defect));
  if (!tangent.multipliers.empty()) text += "\nthe motion closes; multipliers\n";
  for (const Multiplier& multiplier : tangent.multipliers)
    text += fmt::format("  {:+.9g} {:+.9g} i\n", multiplier.real, multiplier.imaginary);
  for (const auto& [constant, changes] : tangent.sensitivities) {
    text += fmt::format("\nd(end)/d({})\n", constant);
    for (std::size_t i = 0; i < changes.size(); ++i)
      text += fmt::format("  {:<12} {}\n", tangent.names[i], core::rounded_text(changes[i], 12));
  }
  return text;
}

std::string to_json(const Tangent& tangent) {
  core::OrderedJson j{{"scene", tangent.scene}, {"method", tangent.method},         {"step", tangent.step},
                      {"until", tangent.until}, {"precision", tangent.precision},   {"names", tangent.names},
                      {"end", tangent.end},     {"directions", tangent.directions}, {"changes", tangent.changes}};
  j["growth"] = core::OrderedJson::array();
  for (std::size_t n = 0; n < tangent.times.size(); ++n)
    j["growth"].push_back(
        {{"t", tangent.times[n]}, {"digits_lost", core::json_number(tangent.growth[n])}, {"means", tangent.means[n]}});
  j["exponents"] = core::OrderedJson::array();
  for (const Exponent& exponent : tangent.exponents)
    j["exponents"].push_back(
        {{"value", core::json_number(exponent.value)}, {"uncertainty", core::json_number(exponent.uncertainty)}});
  j["log10_symplectic_defect"] = core::json_number(tangent.symplectic_defect);
  j["multipliers"] = core::OrderedJson::array();
  for (const Multiplier& multiplier : tangent.multipliers)
    j["multipliers"].push_back({multiplier.real, multiplier.imaginary});
  j["horizon"] = core::OrderedJson::array();
  for (const Horizon& horizon : tangent.horizons) j["horizon"].push_back(core::json_of(horizon));
  j["sensitivities"] = core::OrderedJson::object();
  for (const auto& [constant, changes] : tangent.sensitivities) j["sensitivities"][constant] = changes;
  return core::dumped(j, 2);
}

}  // namespace hbvm

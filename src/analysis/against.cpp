#include "hbvm/analysis/against.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "hbvm/error.hpp"
#include "hbvm/problem/energy_terms.hpp"
#include "hbvm/problem/point.hpp"
#include "hbvm/reference/reference.hpp"
#include "hbvm/reference/reference_motion.hpp"
#include "hbvm/reference/store.hpp"
#include "hbvm/reference/taylor.hpp"
#include "hbvm/scalar/literal.hpp"
#include "hbvm/scalar/text.hpp"
#include "hbvm/scene/assemble.hpp"
#include "results_table.hpp"

namespace hbvm {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// log10 |x|, of 0 less than any.
double log10_of(const Mpfr& x) { return log2_of(x) / std::log2(double{10}); }

/// Significant digits of the longest number.
int digits_of(const ResultsTable& rows) {
  std::size_t most = 0;
  for (const auto& row : rows.cells)
    for (const std::string& cell : row) {
      const std::string mantissa = cell.substr(0, cell.find_first_of("eE"));
      most =
          std::max(most, static_cast<std::size_t>(std::count_if(mantissa.begin(), mantissa.end(),
                                                                [](unsigned char c) { return std::isdigit(c) != 0; })));
    }
  return static_cast<int>(most);
}

/// The rows to be compared: those after the start.
/// \throws InputError, with line and column, for times that do not ascend
std::vector<std::size_t> choose_rows(const ResultsColumns& columns, const ResultsTable& rows, FileAgainst& out) {
  const ResultsColumns::Reading& time = *columns.find("t");
  std::vector<std::size_t> usable;
  Mpfr last = 0;
  std::map<std::string, std::size_t> reasons;
  for (std::size_t row = 0; row < rows.cells.size(); ++row) {
    const Mpfr t = columns.value(time, row);
    if (row > 0 && !(t > last))
      throw InputError(fmt::format("{}:{}: t is {}, which is not later than {} in line {}: times ascend, each once",
                                   out.name, rows.lines[row], columns.text(time, row), columns.text(time, row - 1),
                                   rows.lines[row - 1]));
    last = t;
    if (t > 0)
      usable.push_back(row);
    else
      ++reasons[t < 0 ? "before the start" : "at the start"];
  }
  if (usable.empty()) throw InputError(out.name + ": no time in it is after the start");
  std::vector<std::size_t> chosen;
  const std::size_t count = std::min(most_times, usable.size());
  for (std::size_t i = 1; i <= count; ++i) chosen.push_back(usable[usable.size() * i / count - 1]);
  if (chosen.size() < usable.size())
    reasons[fmt::format("left out: {} of {} times, evenly spaced, are compared", chosen.size(), usable.size())] =
        usable.size() - chosen.size();
  for (const auto& [reason, n] : reasons) out.unused.push_back(fmt::format("{} times {}", n, reason));
  return chosen;
}

/// The states at the times, from the store if it has them all.
std::vector<ReferenceState> states_of(const ReferenceRequest& wanted, bool& stored) {
  std::vector<ReferenceState> states;
  for (const Expression& t : wanted.times) {
    std::optional<FoundReference> found = find_reference(wanted.scene, t, wanted.digits);
    if (!found) break;
    states.push_back(std::move(found->state));
  }
  stored = states.size() == wanted.times.size();
  return stored ? states : compute_reference(wanted).times;
}

/// Digits by the vector in space that a component belongs to: one that happens to be 0 is not worth less.
double right_digits(const Mpfr& error, const Mpfr& size, double most) {
  if (error == 0) return most;
  if (size == 0) return 0;
  return std::clamp(log10_of(size) - log10_of(error), double{0}, most);
}

}  // namespace

Against compare_with_reference(const AgainstRequest& request) {
  constexpr int more_digits = 4, least_digits = 20, greatest_digits = most_reference_digits;
  Against result;
  std::vector<ResultsTable> rows;
  for (const ResultsFile& file : request.files) rows.emplace_back(file);
  for (const ResultsTable& r : rows) result.digits = std::max(result.digits, digits_of(r));
  result.digits = std::clamp(result.digits + more_digits, least_digits, greatest_digits);
  const PrecisionScope scope(static_cast<unsigned>(result.digits + 10));
  const Assembled<Mpfr> scene = assemble<Mpfr>(request.scene);
  const Index d = scene.problem.dimension, m = scene.problem.m();
  EnergyTerms<Mpfr> energy(scene.problem);
  energy.evaluate(scene.q0, scene.p0);
  const Mpfr H0 = energy.H();
  Point<Mpfr> point(scene.problem);
  for (std::size_t f = 0; f < request.files.size(); ++f) {
    FileAgainst& out = result.files.emplace_back();
    out.name = request.files[f].name;
    const ResultsColumns columns(request, request.files[f], rows[f]);
    const std::vector<std::size_t> chosen = choose_rows(columns, rows[f], out);
    const ResultsColumns::Reading& time = *columns.find("t");
    ReferenceRequest wanted;
    wanted.scene = request.scene;
    wanted.digits = result.digits;
    wanted.progress = [&](double part) {
      if (request.progress)
        request.progress((static_cast<double>(f) + part) / static_cast<double>(request.files.size()));
    };
    for (const std::size_t row : chosen) {
      // The exact number that the file has, not one that is near it.
      const std::string text = columns.text(time, row);
      out.times.push_back(text);
      wanted.times.push_back(Expression::parse(text));
    }
    const std::vector<ReferenceState> reference = states_of(wanted, out.stored);
    for (const ResultsColumns::Reading& reading : columns.readings())
      if (reading.ours != "t") out.components.push_back({reading.ours, {}});
    for (std::size_t n = 0; n < chosen.size(); ++n) {
      Vector<Mpfr> q(m), p(m), v(m);
      for (Index j = 0; j < m; ++j) {
        q[j] = literal<Mpfr>(reference[n].q[static_cast<std::size_t>(j)]);
        p[j] = literal<Mpfr>(reference[n].p[static_cast<std::size_t>(j)]);
      }
      scene.problem.mass.velocity(lanes(std::as_const(p)), lanes(v));
      Vector<Mpfr> their_q = q, their_p = p, their_v = v;
      Index of_q = 0, of_p = 0, of_v = 0;
      double worst = -std::numeric_limits<double>::infinity();
      std::size_t component = 0;
      for (const ResultsColumns::Reading& reading : columns.readings()) {
        if (reading.ours == "t") continue;
        const Mpfr theirs = columns.value(reading, chosen[n]);
        const auto place = [&](const std::vector<std::string>& names) -> Index {
          const auto found = std::find(names.begin(), names.end(), reading.ours);
          return found == names.end() ? -1 : static_cast<Index>(found - names.begin());
        };
        const Index of_position = place(columns.positions()), of_momentum = place(columns.momenta());
        const Index j = of_position >= 0 ? of_position : of_momentum >= 0 ? of_momentum : place(columns.velocities());
        const Vector<Mpfr>& ours = of_position >= 0 ? q : of_momentum >= 0 ? p : v;
        Mpfr size = 0;
        for (Index i = j - j % d; i < std::min(j - j % d + d, m); ++i) raise_magnitude(size, ours[i]);
        const Mpfr error = magnitude(Mpfr(theirs - ours[j]));
        out.components[component++].digits.push_back(right_digits(error, size, result.digits));
        if (error > 0 && size > 0) worst = std::max(worst, log10_of(error) - log10_of(size));
        if (of_position >= 0) {
          their_q[j] = theirs;
          ++of_q;
        } else if (of_momentum >= 0) {
          their_p[j] = theirs;
          ++of_p;
        } else {
          their_v[j] = theirs;
          ++of_v;
        }
      }
      out.error = worst;
      if (of_p != m && of_v == m) scene.problem.mass.momentum(their_v, their_p);
      if (of_q == m && (of_p == m || of_v == m)) {
        energy.evaluate(their_q, their_p);
        out.H_drift.push_back(log10_of(Mpfr(energy.H() - H0)) - log10_of(energy.size()));
      }
      if (of_q == m && scene.problem.nu() > 0)
        out.g_drift.push_back(log10_of(max_norm(point.constraints(their_q))) -
                              log10_of(point.constraint_size(their_q)));
    }
    out.step =
        rows[f].cells.size() > 1 ? approximately(Mpfr(columns.value(time, 1) - columns.value(time, 0))) : unknown;
  }
  for (std::size_t f = 0; f + 1 < result.files.size(); ++f) {
    const FileAgainst &a = result.files[f], &b = result.files[f + 1];
    const double steps = std::log10(a.step / b.step);
    // Times that a program added up are not quite the same.
    constexpr long nearly = 1'000'000;
    const Mpfr end_of_a = literal<Mpfr>(a.times.back()), end_of_b = literal<Mpfr>(b.times.back());
    const bool same_end = magnitude(Mpfr(end_of_a - end_of_b)) * nearly <= end_of_a;
    result.orders.push_back(same_end && std::abs(steps) > 0 ? (a.error - b.error) / steps : unknown);
  }
  // The growth of a small change of the start until the first file's times.
  {
    const FileAgainst& first = result.files.front();
    double most = result.digits;
    for (const ComponentDigits& c : first.components) most = std::min(most, c.digits.front());
    const Mpfr delta = literal<Mpfr>("1e-" + std::to_string(result.digits / 2));
    TaylorMotion motion(scene.problem, scene.q0, scene.p0),
        other(scene.problem, Vector<Mpfr>(scene.q0 * (1 + delta)), Vector<Mpfr>(scene.p0 * (1 - delta)));
    double start = unknown;
    for (const std::string& time : first.times) {
      const Mpfr t = literal<Mpfr>(time);
      motion.advance_to(t);
      other.advance_to(t);
      const double grown = log10_of(distance(motion.q(), other.q()));
      if (std::isnan(start)) start = grown;
      result.by_growth.push_back(std::clamp(most - (grown - start), double{0}, static_cast<double>(result.digits)));
    }
  }
  return result;
}

Figure against_figure(const AgainstRequest& request, const Against& against, const std::string& name) {
  Panel panel;
  panel.title = against.files.front().name;
  panel.x.label = "t";
  panel.y.label = "right digits";
  const FileAgainst& file = against.files.front();
  std::vector<double> times;
  const PrecisionScope scope(20);
  for (const std::string& t : file.times) times.push_back(approximately(literal<Mpfr>(t)));
  for (const ComponentDigits& c : file.components) {
    Curve curve{.label = c.name, .points = {}};
    for (std::size_t n = 0; n < times.size(); ++n) curve.points.push_back({times[n], c.digits[n]});
    panel.curves.push_back(std::move(curve));
  }
  Polyline growth{.points = {}, .look = Polyline::Look::dashed};
  for (std::size_t n = 0; n < times.size(); ++n) growth.points.push_back({times[n], against.by_growth[n]});
  panel.lines.push_back(std::move(growth));
  Figure figure;
  figure.name = name;
  figure.caption = "Right digits of " + plain(file.name) + " beside the reference of " + plain(request.scene.name);
  figure.footnote = "dashed: what the growth of the first error alone would leave";
  figure.panels.push_back(std::move(panel));
  return figure;
}

}  // namespace hbvm

#include "compare/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "hbvm/error.hpp"
#include "integrate/observations.hpp"
#include "listed.hpp"
#include "problem/driven_course.hpp"
#include "problem/energy_terms.hpp"
#include "problem/state_evaluator.hpp"
#include "reference/compute_reference.hpp"
#include "reference/reference_motion.hpp"
#include "reference/store.hpp"
#include "reference/taylor.hpp"
#include "results_table.hpp"
#include "run/vector_text.hpp"
#include "scalar/literal.hpp"
#include "scalar/text.hpp"
#include "scene/assemble.hpp"

namespace hbvm {

double Comparison::least_digits() const {
  double least = std::numeric_limits<double>::infinity();
  for (const FileComparison& file : files)
    for (const ComponentDigits& c : file.components) {
      for (const double right : c.digits)
        if (right < least) least = right;
      if (c.off_zero > 0) least = std::min(least, -std::log10(c.off_zero));
    }
  return least;
}

namespace core {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// log10 |x|, of 0 less than any.
double log10_of(const Mpfr& x) { return log2_of(x) / std::log2(double{10}); }

/// Significant digits of the longest number.
int digits_of(const ResultsTable& rows) {
  std::size_t most = 0;
  for (const auto& row : rows.cells)
    for (const std::string& cell : row) {
      std::string digits;
      for (const char c : cell.substr(0, cell.find_first_of("eE")))
        if (std::isdigit(static_cast<unsigned char>(c)) != 0) digits += c;
      const std::size_t leading = digits.find_first_not_of('0');
      if (leading != std::string::npos) most = std::max(most, digits.size() - leading);
    }
  return static_cast<int>(most);
}

/// The rows to be compared: those after the start.
/// \throws InputError, with line and column, for times that do not ascend
std::vector<std::size_t> choose_rows(const ResultsColumns& columns, const ResultsTable& rows, FileComparison& out) {
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
  for (const auto& [reason, n] : reasons)
    out.unused.push_back(fmt::format("{} {} {}", n, n == 1 ? "time" : "times", reason));
  if (!columns.unread().empty()) out.unused.push_back("columns " + listed(columns.unread()));
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
  return size == 0 ? unknown : std::clamp(log10_of(size) - log10_of(error), double{0}, most);
}

/// The coordinates of bodies, and driven ones as they are at t.
Vector<Mpfr> with_driven(const Problem<Mpfr>& problem, const Vector<Mpfr>& of_bodies, const Mpfr& t) {
  Vector<Mpfr> all = Vector<Mpfr>::Zero(problem.m());
  all.head(of_bodies.size()) = of_bodies;
  DrivenCourse<Mpfr> course(problem, 1);
  if (course.empty()) return all;
  course.time(0) = t;
  course.evaluate();
  course.set_positions(lanes(all));
  return all;
}

/// A state of the scene, and where the quantities of a table stand in it.
class Exact {
 public:
  enum Kind { position, momentum, velocity, observed };
  static constexpr std::size_t kinds = 4;
  struct Place {
    Kind kind;
    Index j;
  };

  Exact(const Problem<Mpfr>& problem, Observations<Mpfr>& observations, const Mpfr& t, Vector<Mpfr> q, Vector<Mpfr> p)
      : d_(problem.dimension), vectors_{std::move(q), std::move(p), Vector<Mpfr>(problem.m())} {
    vectors_[observed] = observations.see(t, vectors_[position], vectors_[momentum]);
    problem.mass.velocity(lanes(std::as_const(vectors_[momentum])), lanes(vectors_[velocity]));
  }

  static Place place(const ResultsColumns& columns, const std::string& ours) {
    const auto find = [&](const std::vector<std::string>& names) -> Index {
      const auto found = std::find(names.begin(), names.end(), ours);
      return found == names.end() ? -1 : static_cast<Index>(found - names.begin());
    };
    if (const Index j = find(columns.positions()); j >= 0) return {position, j};
    if (const Index j = find(columns.momenta()); j >= 0) return {momentum, j};
    if (const Index j = find(columns.velocities()); j >= 0) return {velocity, j};
    return {observed, find(columns.observed())};
  }

  const Vector<Mpfr>& all(Kind kind) const { return vectors_[kind]; }
  const Mpfr& value(const Place& at) const { return vectors_[at.kind][at.j]; }
  /// Of the vector in space that it belongs to.
  Mpfr size(const Place& at) const {
    const Vector<Mpfr>& x = vectors_[at.kind];
    Mpfr size = 0;
    if (at.kind == observed) return magnitude(x[at.j]);
    for (Index i = at.j - at.j % d_; i < std::min(at.j - at.j % d_ + d_, x.size()); ++i) raise_magnitude(size, x[i]);
    return size;
  }

 private:
  Index d_;
  std::array<Vector<Mpfr>, kinds> vectors_;
};

/// What a file has at t = 0 beside the start of the scene. Its last two digits may be rounding. That may be of what it
/// was printed with, or of a start computed in double, whatever digits of that are printed.
void compare_start(const ResultsColumns& columns, const ResultsTable& rows, const Exact& start, FileComparison& out) {
  const ResultsColumns::Reading& time = *columns.find("t");
  std::size_t row = 0;
  while (row < rows.cells.size() && columns.value(time, row) != 0) ++row;
  out.has_start = row < rows.cells.size();
  if (!out.has_start) return;
  constexpr int rounded = 2, shown = 8, of_double = 17, most_of_double = 20;
  const int all = digits_of(rows), digits = all <= most_of_double ? std::min(all, of_double) : all;
  const Mpfr resolution = pow(Mpfr(10), std::min(rounded - digits, -1));
  for (const ResultsColumns::Reading& reading : columns.readings()) {
    if (reading.ours == "t") continue;
    const Exact::Place at = Exact::place(columns, reading.ours);
    const Mpfr theirs = columns.value(reading, row);
    const Mpfr &ours = start.value(at), error = magnitude(Mpfr(theirs - ours));
    Mpfr size = start.size(at);
    raise_magnitude(size, theirs);
    if (!(error > resolution * size)) continue;
    const bool opposite = ours != 0 && magnitude(Mpfr(theirs + ours)) <= resolution * size;
    const auto text = [=](const Mpfr& x) { return fmt::format("{:.{}g}", approximately(x), shown); };
    out.start.push_back({reading.ours, text(theirs), text(ours), right_digits(error, size, all), opposite});
  }
}

/// The name of a file above a panel, whole or its end.
std::string panel_title(const std::string& file) {
  constexpr std::size_t room = 40;
  const std::string name = std::filesystem::path(file).filename().string();
  return plain(name.size() <= room ? name : "..." + name.substr(name.size() - room));
}

/// From the coarsest step to the finest; files whose step is unknown are left out.
std::vector<std::size_t> by_step(const std::vector<FileComparison>& files) {
  std::vector<std::size_t> order;
  for (std::size_t f = 0; f < files.size(); ++f)
    if (std::isfinite(files[f].step)) order.push_back(f);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return files[a].step > files[b].step; });
  return order;
}

double order_between(const FileComparison& coarse, const FileComparison& fine) {
  const double steps = std::log10(coarse.step / fine.step);
  // Times that a program added up are not quite the same.
  constexpr long nearly = 1'000'000;
  const Mpfr a = literal<Mpfr>(coarse.times.back()), b = literal<Mpfr>(fine.times.back());
  const bool same_end = magnitude(Mpfr(a - b)) * nearly <= a;
  return same_end && std::abs(steps) > 0 ? (coarse.error - fine.error) / steps : unknown;
}

/// What the text of a file's step says; nothing if it is not known, or if what is stored of it cannot be read.
std::optional<double> step_said(const ResultsFile& file, const Constants& constants) {
  if (file.step.empty()) return std::nullopt;
  try {
    const Mpfr step = magnitude(evaluate<Mpfr>(Expression::parse(file.step), constants));
    if (step > 0) return approximately(step);
    if (file.step_given) throw InputError("it is 0");
  } catch (const InputError& error) {
    if (file.step_given) throw InputError("--steps: '" + file.step + "', of " + file.name + ": " + error.what());
  }
  return std::nullopt;
}

double step_between(const ResultsColumns& columns, const ResultsTable& rows) {
  const ResultsColumns::Reading& time = *columns.find("t");
  return rows.cells.size() > 1 ? approximately(Mpfr(columns.value(time, 1) - columns.value(time, 0))) : unknown;
}

}  // namespace

std::string step_stored(const std::string& csv, const std::string& metadata) {
  const nlohmann::json json = nlohmann::json::parse(metadata, nullptr, false);
  if (json.is_object() && json.contains("hbvm:step") && json["hbvm:step"].is_string())
    return json["hbvm:step"].get<std::string>();
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line) && line.starts_with('#');) {
    std::string words;
    for (const char c : line.substr(1))
      if (std::isspace(static_cast<unsigned char>(c)) == 0) words += c;
    const std::string key = "step=";
    if (words.starts_with(key)) return words.substr(key.size());
  }
  return {};
}

Comparison compare_with_reference(const ComparisonRequest& request) {
  constexpr int more_digits = 4, least_digits = 20, greatest_digits = most_reference_digits;
  Comparison result;
  std::vector<ResultsTable> rows;
  for (const ResultsFile& file : request.files) rows.emplace_back(file);
  for (const ResultsTable& r : rows) result.digits = std::max(result.digits, digits_of(r));
  result.digits = std::clamp(result.digits + more_digits, least_digits, greatest_digits);
  const PrecisionScope scope(static_cast<unsigned>(result.digits + 10));
  const Assembled<Mpfr> scene = assemble<Mpfr>(request.scene);
  const Index m = scene.problem.mass.of_bodies();
  EnergyTerms<Mpfr> energy(scene.problem);
  energy.evaluate(scene.q0, scene.p0);
  const Mpfr H0 = energy.H();
  StateEvaluator<Mpfr> point(scene.problem);
  Observations<Mpfr> observations(request.scene, scene.problem);
  const Exact start_of_scene(scene.problem, observations, Mpfr(0), scene.q0, scene.p0);
  for (std::size_t f = 0; f < request.files.size(); ++f) {
    FileComparison& out = result.files.emplace_back();
    out.name = request.files[f].name;
    const ResultsColumns columns(request, request.files[f], rows[f]);
    columns.check_numbers();
    const std::vector<std::size_t> chosen = choose_rows(columns, rows[f], out);
    const ResultsColumns::Reading& time = *columns.find("t");
    compare_start(columns, rows[f], start_of_scene, out);
    const std::optional<double> said = step_said(request.files[f], request.scene.constants);
    out.step = said ? *said : step_between(columns, rows[f]);
    if (said) out.step_text = request.files[f].step;
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
      if (reading.ours != "t") out.components.push_back({reading.ours, {}, 0});
    std::vector<Exact> exact;
    std::array<Mpfr, Exact::kinds> greatest{};  // of each kind at any of the times
    for (const ReferenceState& state : reference) {
      Vector<Mpfr> p = Vector<Mpfr>::Zero(scene.problem.m());
      p.head(m) = vector_of<Mpfr>(state.p);
      const Mpfr t = evaluate<Mpfr>(Expression::parse(state.t), request.scene.constants);
      exact.emplace_back(scene.problem, observations, t, with_driven(scene.problem, vector_of<Mpfr>(state.q), t),
                         std::move(p));
      for (const auto kind : {Exact::position, Exact::momentum, Exact::velocity})
        raise_to(greatest[kind], max_norm(exact.back().all(kind)));
    }
    for (std::size_t n = 0; n < chosen.size(); ++n) {
      std::array<Vector<Mpfr>, Exact::kinds> theirs_of;
      for (std::size_t kind = 0; kind < Exact::kinds; ++kind)
        theirs_of[kind] = exact[n].all(static_cast<Exact::Kind>(kind));
      std::array<Index, Exact::kinds> known{};
      double worst = -std::numeric_limits<double>::infinity();
      std::size_t component = 0;
      for (const ResultsColumns::Reading& reading : columns.readings()) {
        if (reading.ours == "t") continue;
        const Exact::Place at = Exact::place(columns, reading.ours);
        Mpfr theirs = columns.value(reading, chosen[n]);
        if (at.kind == Exact::observed && observations.is_angle(at.j)) turn_towards(theirs, exact[n].value(at));
        Mpfr size = exact[n].size(at);
        if (size == 0) size = greatest[at.kind];
        const Mpfr error = magnitude(Mpfr(theirs - exact[n].value(at)));
        ComponentDigits& digits = out.components[component++];
        digits.digits.push_back(right_digits(error, size, result.digits));
        if (size == 0) raise_to(digits.off_zero, approximately(error));
        if (error > 0 && size > 0) worst = std::max(worst, log10_of(error) - log10_of(size));
        theirs_of[at.kind][at.j] = theirs;
        ++known[at.kind];
      }
      out.error = worst;
      if (known[Exact::momentum] != m && known[Exact::velocity] == m)
        scene.problem.mass.momentum(theirs_of[Exact::velocity], theirs_of[Exact::momentum]);
      if (known[Exact::position] == m && (known[Exact::momentum] == m || known[Exact::velocity] == m) &&
          scene.problem.is_conservative()) {
        energy.evaluate(theirs_of[Exact::position], theirs_of[Exact::momentum]);
        out.H_drift.push_back(log10_of(Mpfr(energy.H() - H0)) - log10_of(energy.size()));
      }
      if (known[Exact::position] == m && scene.problem.nu() > 0)
        out.g_drift.push_back(log10_of(max_norm(point.constraints(theirs_of[Exact::position]))) -
                              log10_of(point.constraint_size(theirs_of[Exact::position])));
    }
  }
  const std::vector<std::size_t> ordered = by_step(result.files);
  for (std::size_t i = 0; i + 1 < ordered.size(); ++i)
    result.orders.push_back(
        {ordered[i], ordered[i + 1], order_between(result.files[ordered[i]], result.files[ordered[i + 1]])});
  // The growth of a small change of the start until the first file's times.
  {
    const FileComparison& first = result.files.front();
    double most = result.digits;
    for (const ComponentDigits& c : first.components)
      if (c.digits.front() < most) most = c.digits.front();
    const Mpfr delta = literal<Mpfr>("1e-" + std::to_string(result.digits / 2));
    Vector<Mpfr> q0 = scene.q0, p0 = scene.p0;
    q0.head(m) *= 1 + delta;
    p0.head(m) *= 1 - delta;
    TaylorMotion motion(scene.problem, scene.q0, scene.p0), other(scene.problem, q0, p0);
    double grown_first = unknown;
    for (const std::string& time : first.times) {
      const Mpfr t = literal<Mpfr>(time);
      motion.advance_to(t);
      other.advance_to(t);
      const double grown = log10_of(distance(Vector<Mpfr>(motion.q().head(m)), Vector<Mpfr>(other.q().head(m))));
      if (std::isnan(grown_first)) grown_first = grown;
      result.by_growth.push_back(
          std::clamp(most - (grown - grown_first), double{0}, static_cast<double>(result.digits)));
    }
  }
  return result;
}

Figure comparison_figure(const ComparisonRequest& request, const Comparison& against, const std::string& name) {
  const PrecisionScope scope(20);
  Figure figure;
  figure.name = name;
  figure.caption = "Right digits beside the reference of " + plain(request.scene.name);
  for (const FileComparison& file : against.files) {
    Panel panel;
    panel.title = panel_title(file.name);
    panel.x.label = "t";
    panel.y.label = "right digits";
    std::vector<double> times;
    for (const std::string& t : file.times) times.push_back(approximately(literal<Mpfr>(t)));
    for (const ComponentDigits& c : file.components) {
      Curve curve{.label = plain(c.name), .points = {}};
      for (std::size_t n = 0; n < times.size(); ++n) curve.points.push_back({times[n], c.digits[n]});
      panel.curves.push_back(std::move(curve));
    }
    if (figure.panels.empty()) {
      Polyline growth{.points = {}, .look = Polyline::Look::dashed};
      for (std::size_t n = 0; n < times.size(); ++n) growth.points.push_back({times[n], against.by_growth[n]});
      panel.lines.push_back(std::move(growth));
    }
    figure.panels.push_back(std::move(panel));
  }
  figure.footnote = "dashed: what the growth of the first error alone would leave";
  return figure;
}

}  // namespace core

}  // namespace hbvm

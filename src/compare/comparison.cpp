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

#include "audit/convergence.hpp"
#include "compare/lost_digits.hpp"
#include "hbvm/error.hpp"
#include "integrate/observations.hpp"
#include "linear/vector_text.hpp"
#include "listed.hpp"
#include "problem/driven_course.hpp"
#include "reference/compute_reference.hpp"
#include "reference/reference_motion.hpp"
#include "reference/store.hpp"
#include "reference/taylor.hpp"
#include "results_table.hpp"
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
  const int all = rows.digits(), digits = all <= most_of_double ? std::min(all, of_double) : all;
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

/// What the text of a file's step says, which may be a stored one. Nothing if there is none, or if what is stored
/// cannot be read.
std::optional<double> step_said(const ResultsFile& file, const std::string& text, const Constants& constants) {
  const bool given = !file.step.empty();
  if (text.empty()) return std::nullopt;
  try {
    const Mpfr step = magnitude(evaluate<Mpfr>(Expression::parse(text), constants));
    if (step > 0) return approximately(step);
    if (given) throw InputError("it is 0");
  } catch (const InputError& error) {
    if (given) throw InputError("--steps: '" + file.step + "', of " + file.name + ": " + error.what());
  }
  return std::nullopt;
}

double step_between(const ResultsColumns& columns, const ResultsTable& rows) {
  const ResultsColumns::Reading& time = *columns.find("t");
  return rows.cells.size() > 1 ? approximately(Mpfr(columns.value(time, 1) - columns.value(time, 0))) : unknown;
}

/// Compares files one after another with what is exact at their times.
class Referee {
 public:
  Referee(const ComparisonRequest& request, int digits)
      : request_(request),
        digits_(digits),
        scene_(assemble<Mpfr>(request.scene)),
        gauge_(scene_.problem),
        observations_(request.scene, scene_.problem),
        start_(scene_.problem, observations_, Mpfr(0), scene_.q0, scene_.p0) {}

  FileComparison compare(const ResultsFile& file, const ResultsTable& rows,
                         const std::function<void(double)>& progress) {
    FileComparison out;
    out.name = file.name;
    const ResultsColumns columns(request_, file, rows);
    columns.check_numbers();
    const std::vector<std::size_t> chosen = choose_rows(columns, rows, out);
    compare_start(columns, rows, start_, out);
    const std::string step = file.step.empty() ? step_stored(file.csv, file.description) : file.step;
    const std::optional<double> said = step_said(file, step, request_.scene.constants);
    out.step = said ? *said : step_between(columns, rows);
    if (said) out.step_text = step;
    // The exact numbers that the file has, not some that are near them.
    for (const std::size_t row : chosen) out.times.push_back(columns.text(*columns.find("t"), row));
    for (const ResultsColumns::Reading& reading : columns.readings())
      if (reading.ours != "t") out.components.push_back({reading.ours, {}, 0});
    const std::vector<Exact> exact = exact_states(out, progress);
    std::array<Mpfr, Exact::kinds> greatest{};  // of each kind at any of the times
    for (const Exact& state : exact)
      for (const auto kind : {Exact::position, Exact::momentum, Exact::velocity})
        raise_to(greatest[kind], max_norm(state.all(kind)));
    for (std::size_t n = 0; n < chosen.size(); ++n) {
      const std::optional<State> theirs = compare_row(columns, chosen[n], exact[n], greatest, out);
      // From a state without a right digit the motion is another one, which may take any time.
      if (n > 0 || !theirs || !(out.error <= -1)) continue;
      try {
        follow(*theirs, exact, out);
      } catch (const IntegrationError&) {  // there is no motion from such a state
        out.by_growth.clear();
      }
    }
    return out;
  }

  /// What the growth of errors alone would leave of the first digits of files whose states are not complete. Of two
  /// changes of the start, that counts which grows more.
  void estimate_growth(std::vector<FileComparison>& files) const {
    std::map<Mpfr, std::array<double, 2>> grown;  // by the time
    for (const FileComparison& file : files)
      if (file.by_growth.empty())
        for (const std::string& t : file.times) grown.try_emplace(literal<Mpfr>(t));
    if (grown.empty()) return;
    std::vector<Mpfr> times;
    for (const auto& [t, unused] : grown) times.push_back(t);
    const Mpfr change = pow(Mpfr(10), -digits_ / 2);
    const auto growth = growth_of_changes(scene_.problem, scene_.q0, scene_.p0, change, times);
    for (std::size_t n = 0; n < times.size(); ++n) grown[times[n]] = growth[n];
    const double most = digits_;
    for (FileComparison& file : files) {
      if (!file.by_growth.empty()) continue;
      double first = most;
      for (const ComponentDigits& c : file.components)
        if (c.digits.front() < first) first = c.digits.front();
      const std::array<double, 2> start = grown[literal<Mpfr>(file.times.front())];
      for (const std::string& t : file.times) {
        const std::array<double, 2> now = grown[literal<Mpfr>(t)];
        const double lost = std::max(now[0] - start[0], now[1] - start[1]);
        file.by_growth.push_back(std::clamp(first - lost, double{0}, most));
      }
    }
  }

 private:
  std::vector<Exact> exact_states(FileComparison& out, const std::function<void(double)>& progress) {
    ReferenceRequest wanted;
    wanted.scene = request_.scene;
    wanted.digits = digits_;
    wanted.progress = progress;
    for (const std::string& t : out.times) wanted.times.push_back(Expression::parse(t));
    std::vector<Exact> exact;
    for (const ReferenceState& state : states_of(wanted, out.stored)) {
      Vector<Mpfr> p = Vector<Mpfr>::Zero(scene_.problem.m());
      p.head(scene_.problem.mass.of_bodies()) = vector_of<Mpfr>(state.p);
      const Mpfr t = evaluate<Mpfr>(Expression::parse(state.t), request_.scene.constants);
      exact.emplace_back(scene_.problem, observations_, t, with_driven(scene_.problem, vector_of<Mpfr>(state.q), t),
                         std::move(p));
    }
    return exact;
  }

  struct State {
    Vector<Mpfr> q, p;
  };

  /// The exact motion from their first state, and digits of it: so much would be left if they made no further error.
  void follow(State theirs, const std::vector<Exact>& exact, FileComparison& out) {
    gauge_.make_consistent(theirs.q, theirs.p);
    TaylorMotion motion(scene_.problem, theirs.q, theirs.p, end_comparison_if_asked);
    const Mpfr start = literal<Mpfr>(out.times.front());
    for (std::size_t n = 0; n < exact.size(); ++n) {
      motion.advance_to(literal<Mpfr>(out.times[n]) - start);
      double worst = -static_cast<double>(digits_);
      for (const auto kind : {Exact::position, Exact::momentum})
        for (Index j = 0; j < scene_.problem.mass.of_bodies(); ++j) {
          const Mpfr error = (kind == Exact::position ? motion.q() : motion.p())[j] - exact[n].all(kind)[j];
          const Mpfr size = exact[n].size({kind, j});
          if (error != 0 && size > 0) worst = std::max(worst, log10_of(error) - log10_of(size));
        }
      out.by_growth.push_back(std::max(-worst, double{0}));
    }
  }

  /// \return the state, if it is complete
  std::optional<State> compare_row(const ResultsColumns& columns, std::size_t row, const Exact& exact,
                                   const std::array<Mpfr, Exact::kinds>& greatest, FileComparison& out) {
    const Index m = scene_.problem.mass.of_bodies();
    std::array<Vector<Mpfr>, Exact::kinds> theirs_of;
    for (std::size_t kind = 0; kind < Exact::kinds; ++kind) theirs_of[kind] = exact.all(static_cast<Exact::Kind>(kind));
    std::array<Index, Exact::kinds> known{};
    double worst = -std::numeric_limits<double>::infinity();
    std::size_t component = 0;
    for (const ResultsColumns::Reading& reading : columns.readings()) {
      if (reading.ours == "t") continue;
      const Exact::Place at = Exact::place(columns, reading.ours);
      Mpfr theirs = columns.value(reading, row);
      if (at.kind == Exact::observed && observations_.is_angle(at.j)) turn_towards(theirs, exact.value(at));
      Mpfr size = exact.size(at);
      if (size == 0) size = greatest[at.kind];
      const Mpfr error = magnitude(Mpfr(theirs - exact.value(at)));
      ComponentDigits& digits = out.components[component++];
      digits.digits.push_back(right_digits(error, size, digits_));
      if (size == 0) raise_to(digits.off_zero, approximately(error));
      if (error > 0 && size > 0) worst = std::max(worst, log10_of(error) - log10_of(size));
      theirs_of[at.kind][at.j] = theirs;
      ++known[at.kind];
    }
    out.error = worst;
    if (known[Exact::position] != m) return std::nullopt;
    if (known[Exact::momentum] != m && known[Exact::velocity] == m)
      scene_.problem.mass.momentum(theirs_of[Exact::velocity], theirs_of[Exact::momentum]);
    const bool has_constraints = scene_.problem.nu() > 0;
    const bool is_complete = known[Exact::momentum] == m || known[Exact::velocity] == m;
    if (is_complete) {
      const StateDrift drift = gauge_(theirs_of[Exact::position], theirs_of[Exact::momentum],
                                      exact.all(Exact::position), exact.all(Exact::momentum));
      out.H_drift.push_back(drift.H);
      if (has_constraints) out.hidden_drift.push_back(drift.hidden);
    }
    if (has_constraints) out.g_drift.push_back(gauge_.of_g(theirs_of[Exact::position]));
    if (!is_complete) return std::nullopt;
    return State{theirs_of[Exact::position], theirs_of[Exact::momentum]};
  }

  const ComparisonRequest& request_;
  int digits_;
  Assembled<Mpfr> scene_;
  DriftGauge gauge_;
  Observations<Mpfr> observations_;
  Exact start_;
};

/// The order of all files by their errors at the end, each of which is known to the digits of its file.
std::optional<MeasuredOrder> measured_order(const Comparison& against, const std::vector<std::size_t>& ordered,
                                            const std::vector<ResultsTable>& rows) {
  const std::size_t between = against.orders.size();
  if (between < 2) return std::nullopt;
  const double binary = std::log2(double{10});
  std::vector<Rung> rungs;
  for (const std::size_t f : ordered) {
    const FileComparison& file = against.files[f];
    constexpr int of_double = 15;
    rungs.push_back({std::log2(file.step), file.error * binary, -binary * std::min(rows[f].digits(), of_double)});
  }
  if (const std::optional<Rate> rate = convergence_rate(rungs); rate && std::isfinite(rate->uncertainty))
    return MeasuredOrder{rate->value, rate->uncertainty};
  const double last = against.orders[between - 1].order, before = against.orders[between - 2].order;
  if (!std::isfinite(last) || !std::isfinite(before)) return std::nullopt;
  return MeasuredOrder{last, std::abs(last - before)};
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
  for (const ResultsTable& r : rows) result.digits = std::max(result.digits, r.digits());
  result.digits = std::clamp(result.digits + more_digits, least_digits, greatest_digits);
  const PrecisionScope scope(static_cast<unsigned>(result.digits + 10));
  Referee referee(request, result.digits);
  for (std::size_t f = 0; f < request.files.size(); ++f)
    result.files.push_back(referee.compare(request.files[f], rows[f], [&](double part) {
      if (request.progress)
        request.progress((static_cast<double>(f) + part) / static_cast<double>(request.files.size()));
    }));
  referee.estimate_growth(result.files);
  for (FileComparison& file : result.files)
    if (!file.H_drift.empty()) file.mostly = most_lost_by(file, -file.error);
  const std::vector<std::size_t> ordered = by_step(result.files);
  for (std::size_t i = 0; i + 1 < ordered.size(); ++i)
    result.orders.push_back(
        {ordered[i], ordered[i + 1], order_between(result.files[ordered[i]], result.files[ordered[i + 1]])});
  result.measured_order = measured_order(result, ordered, rows);
  return result;
}

Figure comparison_figure(const Comparison& against, const std::string& scene) {
  const PrecisionScope scope(20);
  Figure figure;
  figure.name = "against";
  figure.caption = "Right digits beside the reference of " + plain(scene);
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
    Polyline growth{.points = {}, .look = Polyline::Look::dashed};
    for (std::size_t n = 0; n < times.size(); ++n) growth.points.push_back({times[n], file.by_growth[n]});
    panel.lines.push_back(std::move(growth));
    figure.panels.push_back(std::move(panel));
  }
  figure.footnote = "dashed: what the growth of the first error alone would leave";
  return figure;
}

}  // namespace core

}  // namespace hbvm

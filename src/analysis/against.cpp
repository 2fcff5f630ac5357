#include "hbvm/analysis/against.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <sstream>

#include "hbvm/csv_line.hpp"
#include "hbvm/error.hpp"
#include "hbvm/nearest.hpp"
#include "hbvm/problem/energy_terms.hpp"
#include "hbvm/problem/point.hpp"
#include "hbvm/reference/reference.hpp"
#include "hbvm/reference/reference_motion.hpp"
#include "hbvm/reference/taylor.hpp"
#include "hbvm/scalar/literal.hpp"
#include "hbvm/scalar/text.hpp"
#include "hbvm/scene/assemble.hpp"
#include "hbvm/scene/coordinate_names.hpp"

namespace hbvm {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// log10 |x|, of 0 less than any.
double log10_of(const Mpfr& x) { return log2_of(x) / std::log2(double{10}); }

/// The lines of a file, cell by cell; those that begin with # are comments.
struct Rows {
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> cells;
  std::vector<std::size_t> lines;

  explicit Rows(const ResultsFile& file) {
    std::istringstream text(file.csv);
    std::size_t number = 0;
    for (std::string line; std::getline(text, line);) {
      ++number;
      if (!line.empty() && line.back() == '\r') line.pop_back();
      if (line.empty() || line.front() == '#') continue;
      std::vector<std::string> row = split_csv_line(line);
      for (std::string& cell : row) {
        cell.erase(0, std::min(cell.find_first_not_of(" \t"), cell.size()));
        cell.erase(cell.find_last_not_of(" \t") + 1);
      }
      if (names.empty()) {
        names = std::move(row);
        continue;
      }
      if (row.size() != names.size())
        throw InputError(fmt::format("{}:{}: {} cells, but {} names in the first line", file.name, number, row.size(),
                                     names.size()));
      cells.push_back(std::move(row));
      lines.push_back(number);
    }
    if (cells.empty()) throw InputError(file.name + ": no line of numbers below one of names");
  }
};

/// Names an expression can have for columns whose own it cannot read: "1.x" becomes "c0".
std::string column_name(std::size_t i) { return "c" + std::to_string(i); }

/// A column's name in an expression of the map is replaced where it stands as a whole word.
std::string with_columns(const std::string& expression, const std::vector<std::string>& names) {
  const auto is_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.'; };
  std::string result;
  for (std::size_t at = 0; at < expression.size();) {
    if (!is_word(expression[at])) {
      result += expression[at++];
      continue;
    }
    std::size_t end = at;
    while (end < expression.size() && is_word(expression[end])) ++end;
    const std::string word = expression.substr(at, end - at);
    const auto found = std::find(names.begin(), names.end(), word);
    result += found == names.end() ? word : column_name(static_cast<std::size_t>(found - names.begin()));
    at = end;
  }
  return result;
}

/// What a quantity of ours is in theirs.
struct Reading {
  std::string ours;
  Expression expression;
};

class Columns {
 public:
  Columns(const AgainstRequest& request, const ResultsFile& file, const Rows& rows)
      : file_(file),
        rows_(rows),
        positions_(coordinate_names(request.scene)),
        momenta_(coordinate_names(request.scene, "p")),
        velocities_(coordinate_names(request.scene, "v")) {
    std::vector<std::string> known{"t"};
    for (const auto* list : {&positions_, &momenta_, &velocities_})
      known.insert(known.end(), list->begin(), list->end());
    for (std::size_t i = 0; i < rows.names.size(); ++i) {
      const std::string ours = own_name(rows.names[i]);
      if (std::find(known.begin(), known.end(), ours) != known.end())
        readings_.push_back({ours, Expression::parse(column_name(i))});
    }
    for (const auto& [theirs, ours] : request.map) {
      if (std::find(known.begin(), known.end(), ours) == known.end())
        throw InputError("--map: '" + ours + "' is nothing of this scene; there are t, " + known[1] + ", ... " +
                         momenta_.front() + ", ... " + velocities_.front() + ", ...");
      std::erase_if(readings_, [&, name = ours](const Reading& r) { return r.ours == name; });
      try {
        Expression expression = Expression::parse(with_columns(theirs, rows.names));
        for (const std::string& name : expression.names())
          if (!is_column(name))
            throw InputError("--map: '" + name + "' is no column of " + file.name + did_you_mean(name, rows.names));
        readings_.push_back({ours, std::move(expression)});
      } catch (const ExpressionError& error) {
        throw InputError("--map: '" + theirs + "': " + error.what());
      }
    }
    if (find("t") == nullptr) throw InputError(file.name + ": no column is called t (map one by --map \"theirs=t\")");
    if (readings_.size() < 2)
      throw InputError(file.name + ": no column is one of " + positions_.front() + ", ..., " + momenta_.front() +
                       ", ..., " + velocities_.front() + ", ... (map some by --map \"theirs=ours,...\")");
  }

  const std::vector<Reading>& readings() const { return readings_; }
  const std::vector<std::string>& positions() const { return positions_; }
  const std::vector<std::string>& momenta() const { return momenta_; }
  const std::vector<std::string>& velocities() const { return velocities_; }
  const Reading* find(const std::string& ours) const {
    const auto found =
        std::find_if(readings_.begin(), readings_.end(), [&](const Reading& r) { return r.ours == ours; });
    return found == readings_.end() ? nullptr : &*found;
  }

  /// In the digits of the scope.
  Mpfr value(const Reading& reading, std::size_t row) const {
    Constants columns;
    for (const std::string& name : reading.expression.names()) {
      const std::size_t column = std::stoul(name.substr(1));
      columns.emplace(name, number(row, column));
    }
    try {
      return evaluate<Mpfr>(reading.expression, columns);
    } catch (const ExpressionError& error) {
      throw InputError(fmt::format("{}:{}: {}: {}", file_.name, rows_.lines[row], reading.ours, error.what()));
    }
  }
  Expression number(std::size_t row, std::size_t column) const {
    const std::string& cell = rows_.cells[row][column];
    try {
      Expression x = Expression::parse(cell);
      if (x.names().empty()) return x;
    } catch (const ExpressionError&) {
      // said below
    }
    throw InputError(fmt::format("{}:{}: column '{}' holds '{}', which is no number", file_.name, rows_.lines[row],
                                 rows_.names[column], cell));
  }

 private:
  static bool is_column(const std::string& name) {
    return name.size() > 1 && name[0] == 'c' && name.find_first_not_of("0123456789", 1) == std::string::npos;
  }
  /// "time" is t, and q_3 and p_3 are coordinates by number.
  std::string own_name(const std::string& theirs) const {
    if (theirs == "time") return "t";
    for (const auto& [letter, list] : {std::pair{'q', &positions_}, {'p', &momenta_}, {'v', &velocities_}})
      for (std::size_t i = 0; i < list->size(); ++i)
        if (theirs == fmt::format("{}_{}", letter, i + 1) || theirs == fmt::format("{}{}", letter, i + 1))
          return (*list)[i];
    return theirs;
  }

  const ResultsFile& file_;
  const Rows& rows_;
  std::vector<std::string> positions_, momenta_, velocities_;
  std::vector<Reading> readings_;
};

/// Significant digits of the longest number.
int digits_of(const Rows& rows) {
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

/// The rows to be compared: positive times that ascend.
std::vector<std::size_t> choose_rows(const Columns& columns, const Rows& rows, FileAgainst& out) {
  std::vector<std::size_t> usable;
  Mpfr last = 0;
  std::map<std::string, std::size_t> reasons;
  for (std::size_t row = 0; row < rows.cells.size(); ++row) {
    const Mpfr t = columns.value(*columns.find("t"), row);
    if (t < 0)
      ++reasons["before the start"];
    else if (t > 0 && !(t > last))
      ++reasons["not later than the one before"];
    else if (t > 0) {
      usable.push_back(row);
      last = t;
    }
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

/// Digits by the vector in space that a component belongs to: one that happens to be 0 is not worth less.
double right_digits(const Mpfr& error, const Mpfr& size, double most) {
  if (error == 0) return most;
  if (size == 0) return 0;
  return std::clamp(log10_of(size) - log10_of(error), double{0}, most);
}

}  // namespace

Against compare_with_reference(const AgainstRequest& request) {
  constexpr int more_digits = 4, least_digits = 20, greatest_digits = 200;
  Against result;
  std::vector<Rows> rows;
  for (const ResultsFile& file : request.files) rows.emplace_back(file);
  for (const Rows& r : rows) result.digits = std::max(result.digits, digits_of(r));
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
    const Columns columns(request, request.files[f], rows[f]);
    const std::vector<std::size_t> chosen = choose_rows(columns, rows[f], out);
    const Reading& time = *columns.find("t");
    ReferenceRequest wanted;
    wanted.scene = request.scene;
    wanted.digits = result.digits;
    wanted.progress = [&](double part) {
      if (request.progress)
        request.progress((static_cast<double>(f) + part) / static_cast<double>(request.files.size()));
    };
    for (const std::size_t row : chosen) {
      std::string text;
      // The exact number that the file has, not one that is near it.
      const std::set<std::string> names = time.expression.names();
      if (time.expression.text() == *names.begin())
        text = rows[f].cells[row][std::stoul(names.begin()->substr(1))];
      else
        text = to_text(columns.value(time, row));
      out.times.push_back(text);
      wanted.times.push_back(Expression::parse(text));
    }
    const Reference reference = compute_reference(wanted);
    for (const Reading& reading : columns.readings())
      if (reading.ours != "t") out.components.push_back({reading.ours, {}});
    for (std::size_t n = 0; n < chosen.size(); ++n) {
      Vector<Mpfr> q(m), p(m), v(m);
      for (Index j = 0; j < m; ++j) {
        q[j] = literal<Mpfr>(reference.times[n].q[static_cast<std::size_t>(j)]);
        p[j] = literal<Mpfr>(reference.times[n].p[static_cast<std::size_t>(j)]);
      }
      scene.problem.mass.velocity(lanes(std::as_const(p)), lanes(v));
      Vector<Mpfr> their_q = q, their_p = p;
      Index of_q = 0, of_p = 0;
      double worst = -std::numeric_limits<double>::infinity();
      std::size_t component = 0;
      for (const Reading& reading : columns.readings()) {
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
        }
      }
      out.error = worst;
      if (of_q == m && of_p == m) {
        energy.evaluate(their_q, their_p);
        out.H_drift.push_back(log10_of(Mpfr(energy.H() - H0)) - log10_of(energy.size()));
      }
      if (of_q == m && scene.problem.nu() > 0)
        out.g_drift.push_back(log10_of(max_norm(point.constraints(their_q))) -
                              log10_of(point.constraint_size(their_q)));
    }
    out.step = chosen.size() > 1
                   ? approximately(Mpfr(columns.value(time, std::min<std::size_t>(1, rows[f].cells.size() - 1)) -
                                        columns.value(time, 0)))
                   : unknown;
  }
  for (std::size_t f = 0; f + 1 < result.files.size(); ++f) {
    const FileAgainst &a = result.files[f], &b = result.files[f + 1];
    const double steps = std::log10(a.step / b.step);
    result.orders.push_back(std::abs(steps) > 0 ? (a.error - b.error) / steps : unknown);
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

#include "results_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>

#include "csv_line.hpp"
#include "hbvm/error.hpp"
#include "listed.hpp"
#include "nearest.hpp"
#include "scalar/literal.hpp"
#include "scalar/text.hpp"
#include "scene/coordinate_names.hpp"

namespace hbvm::core {
namespace {

bool is_one_of(const std::string& name, const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Names an expression can have for columns whose own it cannot read: "1.x" becomes "c0".
std::string column_name(std::size_t i) { return "c" + std::to_string(i); }
std::size_t column_of(const std::string& name) { return std::stoul(name.substr(1)); }
bool is_column(const std::string& name) {
  return name.size() > 1 && name[0] == 'c' && name.find_first_not_of("0123456789", 1) == std::string::npos;
}

/// A column's name in an expression of the map is replaced where it stands as a whole word.
/// \throws InputError for a word that would be taken for a column
std::string with_columns(const std::string& expression, const std::vector<std::string>& names,
                         const std::string& file) {
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
    if (found == names.end() && is_column(word)) throw InputError("--map: '" + word + "' is no column of " + file);
    result += found == names.end() ? word : column_name(static_cast<std::size_t>(found - names.begin()));
    at = end;
  }
  return result;
}

}  // namespace

ResultsTable::ResultsTable(const ResultsFile& file) {
  std::istringstream text(file.csv);
  std::size_t number = 0;
  for (std::string line; std::getline(text, line);) {
    ++number;
    if (number == 1 && line.starts_with("\xef\xbb\xbf")) line.erase(0, 3);  // a byte order mark, as spreadsheets write
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.find_first_not_of(" \t") == std::string::npos || line.front() == '#') continue;
    std::vector<std::string> row = split_csv_line(line);
    for (std::string& cell : row) {
      cell.erase(0, std::min(cell.find_first_not_of(" \t"), cell.size()));
      cell.erase(cell.find_last_not_of(" \t") + 1);
    }
    if (names.empty()) {
      if (row.size() == 1 && row[0].find_first_of("; \t") != std::string::npos)
        throw InputError(fmt::format("{}:{}: the names are not separated by commas: '{}'", file.name, number, row[0]));
      if (std::ranges::all_of(row, is_decimal))
        throw InputError(fmt::format("{}:{}: numbers stand where the names of columns are expected, as t,{}", file.name,
                                     number, "q_1,q_2"));
      names = std::move(row);
      for (auto name = names.begin(); name != names.end(); ++name)
        if (std::find(names.begin(), name, *name) != name)
          throw InputError(fmt::format("{}:{}: two columns are called '{}'", file.name, number, *name));
      continue;
    }
    if (row.size() != names.size())
      throw InputError(
          fmt::format("{}:{}: {} cells, but {} names in the first line", file.name, number, row.size(), names.size()));
    cells.push_back(std::move(row));
    lines.push_back(number);
  }
  if (cells.empty()) throw InputError(file.name + ": no line of numbers below one of names");
}

int ResultsTable::digits() const {
  std::size_t most = 0;
  for (const auto& row : cells)
    for (const std::string& cell : row) {
      std::string digits;
      for (const char c : cell.substr(0, cell.find_first_of("eE")))
        if (std::isdigit(static_cast<unsigned char>(c)) != 0) digits += c;
      const std::size_t leading = digits.find_first_not_of('0');
      if (leading != std::string::npos) most = std::max(most, digits.size() - leading);
    }
  return static_cast<int>(most);
}

ResultsColumns::ResultsColumns(const ComparisonRequest& request, const ResultsFile& file, const ResultsTable& rows)
    : file_(file),
      rows_(rows),
      positions_(coordinate_names(request.scene)),
      momenta_(coordinate_names(request.scene, "p")),
      velocities_(coordinate_names(request.scene, "v")) {
  for (const SceneObservation& observation : request.scene.observations) observed_.push_back(observation.name);
  for (std::size_t i = 0; i < rows.names.size(); ++i) {
    const std::string ours = own_name(rows.names[i]);
    if (!is_ours(ours)) continue;
    // Of a trajectory of hbvm run, the momenta of the output state: they are tangential, as those of the reference.
    if (is_one_of(ours, momenta_) && is_one_of("output." + rows.names[i], rows.names)) continue;
    if (find(ours) != nullptr)
      throw InputError(fmt::format("{}: two columns are {}, one of them '{}'", file.name, ours, rows.names[i]));
    readings_.push_back({ours, Expression::parse(column_name(i))});
  }
  read_map(request);
  if (find("t") == nullptr) throw InputError(file.name + ": no column is called t (map one by --map \"theirs=t\")");
  std::set<std::string> read;
  for (const Reading& reading : readings_)
    for (const std::string& name : reading.expression.names()) read.insert(name);
  for (std::size_t i = 0; i < rows.names.size(); ++i)
    if (!read.contains(column_name(i)) && !is_one_of(own_name(rows.names[i]), momenta_))
      unread_.push_back(rows.names[i]);
  if (readings_.size() < 2)
    throw InputError(file.name + ": no column is one of " + positions_.front() + ", ..., " + momenta_.front() +
                     ", ..., " + velocities_.front() + ", ... (map some by --map \"theirs=ours,...\")");
}

void ResultsColumns::read_map(const ComparisonRequest& request) {
  std::set<std::string> mapped;
  for (const auto& [theirs, ours] : request.map) {
    if (!is_ours(ours))
      throw InputError("--map: '" + ours + "' is nothing of this scene; there are t, " + positions_.front() + ", ... " +
                       momenta_.front() + ", ... " + velocities_.front() + ", ..." +
                       (observed_.empty() ? std::string() : ", and it observes " + listed(observed_)));
    if (!mapped.insert(ours).second) throw InputError("--map: '" + ours + "' stands twice on the right of =");
    std::erase_if(readings_, [&, name = ours](const Reading& r) { return r.ours == name; });
    try {
      Expression expression = Expression::parse(with_columns(theirs, rows_.names, file_.name));
      for (const std::string& name : expression.names())
        if (!is_column(name))
          throw InputError("--map: '" + name + "' is no column of " + file_.name + did_you_mean(name, rows_.names));
      readings_.push_back({ours, std::move(expression)});
    } catch (const ExpressionError& error) {
      throw InputError("--map: '" + theirs + "': " + error.what());
    }
  }
}

const ResultsColumns::Reading* ResultsColumns::find(const std::string& ours) const {
  const auto found = std::find_if(readings_.begin(), readings_.end(), [&](const Reading& r) { return r.ours == ours; });
  return found == readings_.end() ? nullptr : &*found;
}

void ResultsColumns::check_numbers() const {
  std::set<std::size_t> columns;
  for (const Reading& reading : readings_)
    for (const std::string& name : reading.expression.names()) columns.insert(column_of(name));
  for (std::size_t row = 0; row < rows_.cells.size(); ++row)
    for (const std::size_t column : columns)
      if (!is_decimal(rows_.cells[row][column])) number(row, column);
}

Mpfr ResultsColumns::value(const Reading& reading, std::size_t row) const {
  Constants columns;
  for (const std::string& name : reading.expression.names()) columns.emplace(name, number(row, column_of(name)));
  try {
    return evaluate<Mpfr>(reading.expression, columns);
  } catch (const ExpressionError& error) {
    throw InputError(fmt::format("{}:{}: {}: {}", file_.name, rows_.lines[row], reading.ours, error.what()));
  }
}

std::string ResultsColumns::text(const Reading& reading, std::size_t row) const {
  const std::set<std::string> names = reading.expression.names();
  if (names.size() == 1 && reading.expression.text() == *names.begin())
    return rows_.cells[row][column_of(*names.begin())];
  return to_text(value(reading, row));
}

Expression ResultsColumns::number(std::size_t row, std::size_t column) const {
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

bool ResultsColumns::is_ours(const std::string& name) const {
  return name == "t" || is_one_of(name, positions_) || is_one_of(name, momenta_) || is_one_of(name, velocities_) ||
         is_one_of(name, observed_);
}

/// "time" is t, q_3 and p_3 are coordinates by number, and momenta may be those of an output state.
std::string ResultsColumns::own_name(const std::string& theirs) const {
  if (theirs == "time") return "t";
  const std::string output = "output.";
  if (theirs.starts_with(output) && is_one_of(theirs.substr(output.size()), momenta_))
    return theirs.substr(output.size());
  for (const auto& [letter, list] : {std::pair{'q', &positions_}, {'p', &momenta_}, {'v', &velocities_}})
    for (std::size_t i = 0; i < list->size(); ++i)
      if (theirs == fmt::format("{}_{}", letter, i + 1) || theirs == fmt::format("{}{}", letter, i + 1))
        return (*list)[i];
  return theirs;
}

}  // namespace hbvm::core

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "hbvm/error.hpp"
#include "read_file.hpp"
#include "scheme/scheme_text.hpp"
#include "toml/toml_table.hpp"

namespace hbvm::core {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> stated_keys{"order",         "embedded_order", "dense_order",
                                           "coupled_order", "nystrom_order",  "digits"};

bool is_stated(const std::string& key) {
  return std::find(stated_keys.begin(), stated_keys.end(), key) != stated_keys.end();
}

/// A number of TOML or a text as it stands: expressions are read later, by name.
std::string number_text(const TomlTable& table, const toml::node& node, const std::string& where) {
  if (node.is_string()) return table.to_string(node, where);
  return table.to_number(node, where).text();
}

SchemeText::Rows rows_of(const TomlTable& table, const toml::node& node, const std::string& key) {
  const toml::array* const array = node.as_array();
  if (!array) table.fail(node, key + " must be an array");
  SchemeText::Rows rows;
  for (const toml::node& entry : *array) {
    const toml::array* const row = entry.as_array();
    if (!row) {
      if (rows.empty()) rows.emplace_back();
      rows.front().push_back(number_text(table, entry, key));
      continue;
    }
    rows.emplace_back();
    for (const toml::node& x : *row) rows.back().push_back(number_text(table, x, key));
  }
  return rows;
}

SchemeText from_toml(const std::string& text, const std::string& file) {
  const TomlSource source(text, file);
  const toml::table root = source.parse();
  TomlTable table(source, root, "scheme");
  SchemeText scheme;
  for (const auto& [key, node] : root) {
    const std::string name(key.str());
    if (is_stated(name))
      scheme.stated[name] = table.integer(name);
    else if (name == "name" || name == "family")
      (name == "name" ? scheme.name : scheme.family) = table.string(name);
    else
      scheme.arrays[name] = rows_of(table, node, name);
  }
  return scheme;
}

/// The characters of a number in JSON; a text is what it says.
std::string number_text(const nlohmann::json& x, const std::string& key) {
  if (x.is_string()) return x.get<std::string>();
  if (x.is_number()) return x.dump();
  throw InputError(key + " holds " + x.dump() + ", which is no number");
}

SchemeText from_json(const std::string& text) {
  SchemeText scheme;
  const nlohmann::json root = nlohmann::json::parse(text);
  if (!root.is_object()) throw InputError("a scheme is an object, { \"A\": [...], \"b\": [...] }");
  for (const auto& [key, value] : root.items()) {
    if (is_stated(key)) {
      if (!value.is_number_integer()) throw InputError("'" + key + "' must be a whole number");
      scheme.stated[key] = value.get<long>();
    } else if (key == "name" || key == "family") {
      if (!value.is_string()) throw InputError("'" + key + "' must be a text");
      (key == "name" ? scheme.name : scheme.family) = value.get<std::string>();
    } else if (!value.is_array()) {
      throw InputError("'" + key + "' must be an array");
    } else {
      SchemeText::Rows& rows = scheme.arrays[key];
      for (const nlohmann::json& entry : value) {
        if (!entry.is_array()) {
          if (rows.empty()) rows.emplace_back();
          rows.front().push_back(number_text(entry, key));
          continue;
        }
        rows.emplace_back();
        for (const nlohmann::json& x : entry) rows.back().push_back(number_text(x, key));
      }
    }
  }
  return scheme;
}

/// The numbers of a line; a rule of dashes has none.
std::vector<std::string> numbers_in(const std::string& line) {
  std::vector<std::string> numbers;
  std::string number;
  for (const char c : line + " ") {
    if (std::string_view(" \t\r,;|&").find(c) == std::string_view::npos) {
      number += c;
    } else if (!number.empty()) {
      if (number.find_first_not_of("-+=_") != std::string::npos) numbers.push_back(number);
      number.clear();
    }
  }
  return numbers;
}

/// c | A in s rows, and one or two rows of weights below. These may lack c, or have a number in its place.
SchemeText from_grid(const std::string& text) {
  SchemeText::Rows rows;
  std::string line;
  for (const char c : text + "\n") {
    if (c != '\n') {
      line += c;
      continue;
    }
    line = line.substr(0, line.find('#'));
    if (std::vector<std::string> numbers = numbers_in(line); !numbers.empty()) rows.push_back(std::move(numbers));
    line.clear();
  }
  if (rows.size() < 2) throw InputError("a printed tableau has rows with c and A, and a row of weights");
  // The rows of an explicit method may end where its zeros begin.
  std::size_t s = 0;
  for (const auto& row : rows) s = std::max(s, row.size());
  SchemeText scheme;
  const auto weights = [&](std::vector<std::string> row, std::size_t stages) {
    if (row.size() == stages + 1) row.erase(row.begin());
    if (row.size() != stages)
      throw InputError("a row of weights has " + std::to_string(row.size()) + " numbers for " + std::to_string(stages) +
                       " stages");
    return SchemeText::Rows{std::move(row)};
  };
  // With two rows of weights there are two rows more than stages, else one.
  for (const std::size_t below : {1u, 2u}) {
    const std::size_t stages = rows.size() - below;
    if (stages == 0 || (s != stages && s != stages + 1)) continue;
    SchemeText::Rows A, c(1);
    bool fits = true;
    for (std::size_t i = 0; i < stages && fits; ++i) {
      std::vector<std::string> row(rows[i].begin() + 1, rows[i].end());
      fits = row.size() == stages || row.size() <= i + 1;
      row.resize(stages, "0");
      A.push_back(row);
      c.front().push_back(rows[i].front());
    }
    const std::size_t last = rows[stages].size();
    if (!fits || (last != stages && last != stages + 1)) continue;
    scheme.arrays = {{"A", A}, {"c", c}, {"b", weights(rows[stages], stages)}};
    if (below == 2) scheme.arrays["b_hat"] = weights(rows[stages + 1], stages);
    return scheme;
  }
  throw InputError("these " + std::to_string(rows.size()) + " rows are no tableau: c and A in s rows, and one or two " +
                   "rows of s weights");
}

}  // namespace

SchemeText read_scheme_text(const std::string& file) {
  constexpr std::uintmax_t limit = 10'000'000;
  std::error_code failure;
  if (!fs::is_regular_file(file, failure)) throw InputError("cannot read " + file);
  if (fs::file_size(file, failure) > limit) throw InputError(file + ": too large for a scheme");
  const std::string text = read_file(file), kind = fs::path(file).extension().string();
  SchemeText scheme;
  if (kind == ".toml") {
    scheme = from_toml(text, file);
  } else {
    try {
      scheme = kind == ".json" ? from_json(text) : from_grid(text);
    } catch (const nlohmann::json::exception& error) {
      throw InputError(file + ": " + error.what());
    } catch (const InputError& error) {
      throw InputError(file + ": " + error.what());
    }
  }
  scheme.file = file;
  if (scheme.name.empty()) scheme.name = fs::path(file).stem().string();
  return scheme;
}

}  // namespace hbvm::core

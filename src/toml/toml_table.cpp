#include "toml/toml_table.hpp"

#include <algorithm>

#include "nearest.hpp"
#include "toml/toml_flaw.hpp"

namespace hbvm::core {

TomlSource::TomlSource(std::string text, std::string name, std::set<std::string, std::less<>> top_keys)
    : text_(std::move(text)), name_(std::move(name)), top_keys_(std::move(top_keys)) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text_.starts_with(byte_order_mark)) text_.erase(0, byte_order_mark.size());
  line_starts_.push_back(0);
  for (std::size_t i = 0; i < text_.size(); ++i)
    if (text_[i] == '\n') line_starts_.push_back(i + 1);
}

void TomlSource::fail(std::size_t line, const std::string& what) const {
  std::string message = name_ + (line > 0 ? ":" + std::to_string(line) : "") + ": " + what;
  for (char& c : message)
    if (static_cast<unsigned char>(c) < ' ') c = ' ';  // one line, whatever the file holds
  throw InputError(message);
}

toml::table TomlSource::parse() const {
  if (const auto mark = text_.find("\xEF\xBB\xBF"); mark != std::string::npos)
    fail(static_cast<std::size_t>(std::upper_bound(line_starts_.begin(), line_starts_.end(), mark) -
                                  line_starts_.begin()),
         "a byte order mark (U+FEFF) stands inside the file");
  if (const auto flaw = find_flaw(text_)) fail(flaw->line, flaw->what);
  try {
    return toml::parse(text_, name_);
  } catch (const toml::parse_error& error) {
    fail(error.source().begin.line, std::string(error.description()));
  }
}

std::size_t TomlSource::offset_of(const toml::source_position& place) const {
  if (place.line == 0 || place.line > line_starts_.size()) return text_.size();
  std::size_t at = line_starts_[place.line - 1];
  // Columns count characters, which may take several bytes: continuation bytes are 10xxxxxx.
  for (std::size_t column = 1; column < place.column && at < text_.size(); ++column) {
    ++at;
    while (at < text_.size() && (static_cast<unsigned char>(text_[at]) & 0xC0) == 0x80) ++at;
  }
  return at;
}

toml::source_position TomlSource::begin_of(std::string_view string, const toml::source_region& region) const {
  const std::size_t begin = offset_of(region.begin), end = offset_of(region.end);
  const std::size_t found = std::string_view(text_).substr(0, end).find(string, begin + 1);  // after the quote
  if (begin >= end || found == std::string_view::npos) return {region.begin.line, 0};
  const auto after = std::upper_bound(line_starts_.begin(), line_starts_.end(), found);
  const auto line = static_cast<std::size_t>(after - line_starts_.begin());
  return {static_cast<toml::source_index>(line), static_cast<toml::source_index>(found - *(after - 1) + 1)};
}

std::string TomlSource::number_at(const toml::source_position& begin) const {
  std::size_t at = offset_of(begin);
  std::string number;
  for (; at < text_.size(); ++at) {
    const char c = text_[at];
    if (c == '_') continue;
    if (!((c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.' || c == 'e' || c == 'E')) break;
    number += c;
  }
  return number;
}

TomlTable::TomlTable(const TomlSource& source, const toml::table& table, std::string what)
    : source_(source), table_(table), what_(std::move(what)), line_(table.source().begin.line) {}

void TomlTable::fail(const toml::node& node, const std::string& what) const {
  const std::size_t line = node.source().begin.line;
  source_.fail(line > 0 ? line : line_, what_ + ": " + what);
}

const toml::node* TomlTable::take(std::string_view key) {
  known_.emplace(key);
  return table_.get(key);
}

const toml::node& TomlTable::require(std::string_view key) {
  const toml::node* const node = take(key);
  if (!node) missing({std::string(key)});
  return *node;
}

void TomlTable::missing(const std::vector<std::string>& keys) const {
  // A misspelt key is more likely than a forgotten one.
  for (const auto& [present, value] : table_) {
    if (known_.contains(present.str())) continue;
    if (!nearest(present.str(), keys).empty())
      fail(value, "unknown key '" + std::string(present.str()) + "'" + did_you_mean(present.str(), keys));
  }
  for (const std::string& key : keys) {
    if (!source_.is_top_key(key)) continue;
    const auto look_inside = [&](const toml::table& table, const std::string& name) {
      if (const toml::node* const node = table.get(key)) TomlTable(source_, table, name).misplaced(key, *node);
    };
    for (const auto& [name, value] : table_) {
      if (const toml::table* const table = value.as_table()) look_inside(*table, std::string(name.str()));
      if (const toml::array* const array = value.as_array())
        for (const toml::node& entry : *array)
          if (const toml::table* const table = entry.as_table()) look_inside(*table, std::string(name.str()));
    }
  }
  std::string others;
  for (std::size_t i = 1; i < keys.size(); ++i) others += std::string(i > 1 ? " " : "") + "or '" + keys[i] + "'";
  fail("the key '" + keys.front() + "' is missing" + (others.empty() ? "" : " (" + others + ")"));
}

void TomlTable::misplaced(std::string_view key, const toml::node& node) const {
  const std::string name(key);
  const toml::array* const array = node.as_array();
  const bool tables = array && !array->empty() && array->front().is_table();
  fail(node, "'" + name + "' stands inside this table, as all does that follows a header in brackets; write '" + name +
                 " = ...' above the first header" + (tables ? ", or as [[" + name + "]] tables" : ""));
}

std::string TomlTable::to_string(const toml::node& node, const std::string& where) const {
  const auto text = node.value_exact<std::string>();
  if (!text) fail(node, where + " must be a string");
  return *text;
}

std::string TomlTable::string(std::string_view key) {
  const toml::node& node = require(key);
  std::string text = to_string(node, "'" + std::string(key) + "'");
  if (text.empty()) fail(node, "'" + std::string(key) + "' must not be empty");
  return text;
}

std::string TomlTable::optional_string(std::string_view key) {
  const toml::node* const node = take(key);
  return node ? to_string(*node, "'" + std::string(key) + "'") : std::string();
}

long TomlTable::integer(std::string_view key) {
  const toml::node& node = require(key);
  const auto value = node.value_exact<std::int64_t>();
  if (!value || !std::in_range<long>(*value)) fail(node, "'" + std::string(key) + "' must be a whole number");
  return static_cast<long>(*value);
}

bool TomlTable::is_array(std::string_view key) const {
  const toml::node* const node = table_.get(key);
  return node && node->is_array();
}

Expression TomlTable::to_number(const toml::node& node, const std::string& where) const {
  try {
    if (const auto text = node.value_exact<std::string>()) return Expression::parse(*text);
    if (const auto whole = node.value_exact<std::int64_t>()) return Expression::parse(std::to_string(*whole));
    if (node.is_floating_point()) {
      const std::string text = source_.number_at(node.source().begin);
      if (text.find_first_of("0123456789") == std::string::npos) fail(node, where + " must be finite");
      return Expression::parse(text);
    }
  } catch (const ExpressionError& error) {
    fail(node, where + ": " + error.what());
  }
  fail(node, where + " must be a number or an expression in quotes");
}

Expression TomlTable::number(std::string_view key) { return to_number(require(key), "'" + std::string(key) + "'"); }

std::optional<Expression> TomlTable::optional_number(std::string_view key) {
  const toml::node* const node = take(key);
  if (!node) return std::nullopt;
  return to_number(*node, "'" + std::string(key) + "'");
}

std::vector<Expression> TomlTable::to_vector(const toml::node& node, std::size_t size, const std::string& where) const {
  const toml::array* const array = node.as_array();
  if (!array) fail(node, where + " must be an array of " + std::to_string(size) + " numbers");
  if (array->size() != size)
    fail(node, where + " has " + std::to_string(array->size()) + " entries instead of " + std::to_string(size));
  std::vector<Expression> result;
  for (const toml::node& entry : *array)
    result.push_back(to_number(entry, "entry " + std::to_string(result.size() + 1) + " of " + where));
  return result;
}

std::vector<Expression> TomlTable::vector(std::string_view key, std::size_t size) {
  return to_vector(require(key), size, "'" + std::string(key) + "'");
}

std::vector<std::vector<Expression>> TomlTable::matrix(std::string_view key, std::size_t size) {
  const toml::node& node = require(key);
  const std::string where = "'" + std::string(key) + "'";
  const toml::array* const array = node.as_array();
  if (!array || array->size() != size) fail(node, where + " must be an array of " + std::to_string(size) + " rows");
  std::vector<std::vector<Expression>> result;
  for (const toml::node& row : *array)
    result.push_back(to_vector(row, size, "row " + std::to_string(result.size() + 1) + " of " + where));
  return result;
}

std::vector<std::string> TomlTable::strings(std::string_view key) {
  const toml::node& node = require(key);
  const toml::array* const array = node.as_array();
  if (!array) fail(node, "'" + std::string(key) + "' must be an array of names");
  std::vector<std::string> result;
  for (const toml::node& entry : *array) result.push_back(to_string(entry, "each entry of '" + std::string(key) + "'"));
  return result;
}

std::vector<const toml::table*> TomlTable::tables(std::string_view key) {
  const toml::node* const node = take(key);
  if (!node) return {};
  const toml::array* const array = node->as_array();
  std::vector<const toml::table*> result;
  if (array)
    for (const toml::node& entry : *array)
      if (entry.is_table()) result.push_back(entry.as_table());
  if (!array || result.size() != array->size())
    fail(*node, "'" + std::string(key) + "' must be written as [[" + std::string(key) + "]] tables");
  return result;
}

void TomlTable::finish() const {
  for (const auto& [key, value] : table_) {
    if (known_.contains(key.str())) continue;
    if (source_.is_top_key(key.str())) misplaced(key.str(), value);
    const std::string guess = did_you_mean(key.str(), {known_.begin(), known_.end()});
    std::string all;
    for (const std::string& known : known_) all += (all.empty() ? "; those there are: " : ", ") + known;
    fail(value, "unknown key '" + std::string(key.str()) + "'" + (guess.empty() ? all : guess));
  }
}

void TomlTable::expect(const std::vector<std::string>& keys) {
  known_.insert(keys.begin(), keys.end());
  finish();
}

}  // namespace hbvm::core

#include "method/read_tableau.hpp"

#include <filesystem>

#include "read_file.hpp"
#include "toml/toml_table.hpp"

namespace hbvm::core {
namespace {

std::string numbered(std::size_t i) { return "[" + std::to_string(i + 1) + "]"; }

/// Refuses a number that has no value, which shows in any number of bits.
void check_value(const TomlTable& table, const toml::node& node, const Expression& number, const std::string& place) {
  try {
    constexpr int bits = 53;
    static_cast<void>(number.evaluate_to_bits(bits));
  } catch (const ExpressionError& error) {
    table.fail(node, place + " has no value: " + error.what());
  }
}

const toml::array& array_of(const TomlTable& table, const toml::node& node, std::string_view place) {
  const toml::array* const array = node.as_array();
  if (!array) table.fail(node, std::string(place) + " must be an array");
  return *array;
}

Numbers entries(const TomlTable& table, const toml::node& node, std::size_t size, const std::string& place) {
  const toml::array& array = array_of(table, node, place);
  if (array.size() != size)
    table.fail(
        node, place + " has " + std::to_string(array.size()) + " entries, but A has " + std::to_string(size) + " rows");
  Numbers result;
  for (const toml::node& entry : array) {
    const std::string where = place + numbered(result.size());
    const Expression number = table.to_number(entry, where);
    check_value(table, entry, number, where);
    result.emplace_back(number.text());
  }
  return result;
}

/// The sum of a row, as an expression.
Number sum_of(const TomlTable& table, const toml::node& node, const Numbers& row, const std::string& place) {
  std::string text;
  for (const Number& number : row)
    if (number.text() != "0") text += (text.empty() ? "(" : "+(") + number.text() + ")";
  try {
    const Expression sum = Expression::parse(text.empty() ? "0" : text);
    check_value(table, node, sum, "the sum of " + place);
    return sum.text();
  } catch (const ExpressionError&) {
    table.fail(node, place + " holds too many operations to be summed: state c");
  }
}

}  // namespace
}  // namespace hbvm::core

namespace hbvm {

Tableau read_tableau(const std::string& path) {
  using namespace core;
  namespace fs = std::filesystem;
  constexpr std::uintmax_t limit = 10'000'000;
  std::error_code failure;
  if (!fs::is_regular_file(path, failure)) throw InputError("cannot read " + path);
  if (fs::file_size(path, failure) > limit) throw InputError(path + ": too large for a tableau");
  const TomlSource source(read_file(path), path);
  const toml::table root = source.parse();
  TomlTable top(source, root, "tableau");
  Tableau tableau;
  tableau.name = top.has("name") ? top.string("name") : fs::path(path).stem().string();
  if (const toml::node* const node = top.take("order")) {
    // No method of s stages has an order above 2 s.
    const long order = top.integer("order");
    if (order < 1 || order > 2 * static_cast<long>(max_tableau_stages))
      top.fail(*node, "'order' must be from 1 to " + std::to_string(2 * max_tableau_stages));
    tableau.order = static_cast<int>(order);
  }
  if (const toml::node* const node = top.take("digits")) {
    const long digits = top.integer("digits");
    if (digits < 1 || digits > max_tableau_digits)
      top.fail(*node, "'digits' must be from 1 to " + std::to_string(max_tableau_digits));
    tableau.digits = static_cast<int>(digits);
  }
  const toml::node *const A = &top.require("A"), *const b = &top.require("b"), *const c = top.take("c");
  top.finish();

  const toml::array& rows = array_of(top, *A, "A");
  const std::size_t s = rows.size();
  if (s == 0 || s > max_tableau_stages)
    top.fail(*A, "A has " + std::to_string(s) + " rows: a method has from 1 to " + std::to_string(max_tableau_stages) +
                     " stages");
  for (const toml::node& row : rows) tableau.A.push_back(entries(top, row, s, "A" + numbered(tableau.A.size())));
  tableau.b = entries(top, *b, s, "b");
  if (c)
    tableau.c = entries(top, *c, s, "c");
  else
    for (std::size_t i = 0; i < s; ++i) tableau.c.push_back(sum_of(top, rows[i], tableau.A[i], "A" + numbered(i)));
  return tableau;
}

}  // namespace hbvm

#include "section/starts.hpp"

#include <charconv>
#include <set>

#include "hbvm/error.hpp"
#include "outside_parentheses.hpp"

namespace hbvm::core {
namespace {

constexpr std::size_t most = 10'000;

long count_of(const std::string& text, const std::string& whole) {
  long count = 0;
  const char* const end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, count);
  if (error != std::errc() || stopped != end || count < 1 || count > static_cast<long>(most))
    throw InputError("'" + whole + "': '" + text + "' is no number of starts from 1 to " + std::to_string(most));
  return count;
}

}  // namespace

VariedNumber parse_starts(const std::string& text) {
  const std::string usage = "'" + text + "': use NAME=FROM:TO:COUNT, or NAME=A,B,C";
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) throw InputError(usage);
  VariedNumber number{text.substr(0, equals), {}};
  const std::string rest = text.substr(equals + 1);
  const std::vector<std::string> range = split_outside_parentheses(rest, ':');
  if (range.size() == 1) {
    for (const std::string& value : split_outside_parentheses(rest, ','))
      number.values.push_back(Expression::parse(value));
    return number;
  }
  if (range.size() != 3) throw InputError(usage);
  const Expression from = Expression::parse(range[0]), to = Expression::parse(range[1]);
  const long count = count_of(range[2], text);
  number.values = count == 1 ? std::vector{from} : values_between(from, to, count);
  return number;
}

std::vector<VariedScene> starts_of(const Scene& scene, const std::vector<VariedNumber>& numbers) {
  std::set<std::string> names;
  std::size_t count = 1;
  for (const VariedNumber& number : numbers) {
    if (!names.insert(number.name).second) throw InputError("starts differ by '" + number.name + "' twice");
    count *= number.values.size();
    if (count > most) throw InputError("there are more than " + std::to_string(most) + " starts");
  }
  return varied_scenes(scene, numbers);
}

}  // namespace hbvm::core

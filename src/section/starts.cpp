#include "section/starts.hpp"

#include <charconv>
#include <set>

#include "scene/set_number.hpp"

namespace hbvm::core {
namespace {

constexpr std::size_t most = 10'000;

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts{""};
  int open = 0;
  for (const char c : text) {
    open += c == '(' ? 1 : c == ')' ? -1 : 0;
    if (c == at && open == 0)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

long count_of(const std::string& text, const std::string& whole) {
  long count = 0;
  const char* const end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, count);
  if (error != std::errc() || stopped != end || count < 1 || count > static_cast<long>(most))
    throw InputError("'" + whole + "': '" + text + "' is no number of starts from 1 to " + std::to_string(most));
  return count;
}

}  // namespace

StartAxis parse_start_axis(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw InputError("'" + text + "': use NAME=FROM:TO:COUNT, or NAME=A,B,C");
  StartAxis axis{text.substr(0, equals), {}};
  const std::string rest = text.substr(equals + 1);
  const std::vector<std::string> range = split(rest, ':');
  if (range.size() == 1) {
    for (const std::string& value : split(rest, ',')) axis.values.push_back(Expression::parse(value));
    return axis;
  }
  if (range.size() != 3) throw InputError("'" + text + "': use NAME=FROM:TO:COUNT, or NAME=A,B,C");
  const Expression from = Expression::parse(range[0]), to = Expression::parse(range[1]);
  const long count = count_of(range[2], text);
  if (count == 1) {
    axis.values.push_back(from);
    return axis;
  }
  for (long n = 0; n < count; ++n)
    axis.values.push_back(Expression::parse("(" + from.text() + ")+((" + to.text() + ")-(" + from.text() + "))*" +
                                            std::to_string(n) + "/" + std::to_string(count - 1)));
  return axis;
}

std::vector<SectionStart> starts_of(const Scene& scene, const std::vector<StartAxis>& axes) {
  std::set<std::string> names;
  std::size_t count = 1;
  for (const StartAxis& axis : axes) {
    if (!names.insert(axis.name).second) throw InputError("starts differ by '" + axis.name + "' twice");
    count *= axis.values.size();
    if (count > most) throw InputError("there are more than " + std::to_string(most) + " starts");
  }
  std::vector<SectionStart> starts{{{}, scene}};
  for (const StartAxis& axis : axes) {
    std::vector<SectionStart> more;
    for (const SectionStart& start : starts)
      for (const Expression& value : axis.values) {
        SectionStart& next = more.emplace_back(start);
        next.values.push_back(value.text());
        next.scene = with_number(start.scene, axis.name, value);
      }
    starts = std::move(more);
  }
  return starts;
}

}  // namespace hbvm::core

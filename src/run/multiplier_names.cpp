#include "run/multiplier_names.hpp"

#include <algorithm>

namespace hbvm::core {
namespace {

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

/// "hinge 'frame[0, 0]'-'wheel[1, 0]' (axis, 1)" as "hinge frame-wheel, across e".
std::string short_name(std::string name, bool with_points) {
  if (const std::size_t part = name.rfind(" ("); part != std::string::npos && name.ends_with(')'))
    name = name.substr(0, part) + ", " + name.substr(part + 2, name.size() - part - 3);
  const std::size_t kind = name.find(" '");
  std::replace(name.begin(), name.begin() + static_cast<std::ptrdiff_t>(std::min(kind, name.size())), '_', ' ');
  replace_all(name, ", point, ", ", ");
  replace_all(name, ", axis, 1", ", across e");
  replace_all(name, ", axis, 2", ", across f");
  std::erase(name, '\'');
  if (with_points) return name;
  for (std::size_t open = 0; (open = name.find('[')) != std::string::npos;) {
    const std::size_t close = name.find(']', open);
    if (close == std::string::npos) break;
    name.erase(open, close - open + 1);
  }
  return name;
}

}  // namespace

std::vector<std::string> multiplier_names(const Recording& recording) {
  std::vector<std::string> names, longer;
  for (const std::size_t i : shown_multipliers(recording)) {
    names.push_back(short_name(recording.constraints[i], false));
    longer.push_back(short_name(recording.constraints[i], true));
  }
  std::vector<std::string> result = names;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (std::count(names.begin(), names.end(), names[i]) > 1) result[i] = longer[i];
  names = result;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (std::count(names.begin(), names.end(), names[i]) == 1) continue;
    const auto here = names.begin() + static_cast<std::ptrdiff_t>(i);
    result[i] += ", " + std::to_string(std::count(names.begin(), here, names[i]) + 1);
  }
  return result;
}

}  // namespace hbvm::core

#include "resume.hpp"

#include <algorithm>

#include "hbvm/error.hpp"

namespace hbvm::core {
namespace {

bool is_one_of(const std::string& name, const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Where a run is kept is no part of what it is.
bool says_where(const std::string& name) { return is_one_of(name, {"--help", "--checkpoint", "--resume"}); }

bool may_be_another(const std::string& name) {
  return is_one_of(name, {"scene", "--start", "--out", "--every-seconds", "--json"});
}

std::string given(const CLI::Option& option) {
  std::string text;
  for (const std::string& result : option.results()) text += (text.empty() ? "" : " ") + result;
  return text;
}

bool is_flag(const CLI::Option& option) { return option.get_items_expected_max() == 0; }

/// "with --every 3", "without --reverse".
std::string shown(const CLI::Option& option, const std::string& text) {
  const std::string name = option.get_name();
  if (text.empty()) return "without " + name;
  return "with " + name + (is_flag(option) ? std::string() : " " + text);
}

}  // namespace

GivenOptions given_options(const CLI::App& command) {
  GivenOptions result;
  for (const CLI::Option* option : command.get_options())
    if (option->count() > 0 && !says_where(option->get_name())) result.emplace_back(option->get_name(), given(*option));
  return result;
}

void take_options(CLI::App& command, const std::string& file, const Checkpoint& checkpoint) {
  const GivenOptions& known = checkpoint.identity.options;
  for (CLI::Option* const option : command.get_options()) {
    const std::string name = option->get_name();
    if (says_where(name)) continue;
    const auto place = std::find_if(known.begin(), known.end(), [&](const auto& entry) { return entry.first == name; });
    const bool was_given = place != known.end();
    if (option->count() == 0) {
      if (!was_given) continue;
      option->add_result(place->second);
      option->run_callback();
      continue;
    }
    if (may_be_another(name) && (was_given || name == "--json" || name == "--every-seconds")) continue;
    const std::string now = given(*option), then = was_given ? place->second : option->get_default_str();
    if (now != then)
      throw InputError("--resume: '" + file + "' was written " + shown(*option, then) + ", and the command is " +
                       shown(*option, now));
  }
}

}  // namespace hbvm::core

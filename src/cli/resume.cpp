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

std::string joined(const std::vector<std::string>& results) {
  std::string text;
  for (const std::string& result : results) text += (text.empty() ? "" : " ") + result;
  return text;
}

/// What was given for an option, each time it was.
std::vector<std::string> results_of(const GivenOptions& options, const std::string& name) {
  std::vector<std::string> results;
  for (const auto& [option, result] : options)
    if (option == name) results.push_back(result);
  return results;
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
    if (option->count() > 0 && !says_where(option->get_name()))
      for (const std::string& text : option->results()) result.emplace_back(option->get_name(), text);
  return result;
}

void take_options(CLI::App& command, const std::string& file, const Checkpoint& checkpoint) {
  const GivenOptions& known = checkpoint.identity.options;
  for (CLI::Option* const option : command.get_options()) {
    const std::string name = option->get_name();
    if (says_where(name)) continue;
    const std::vector<std::string> before = results_of(known, name);
    const bool was_given = !before.empty();
    if (option->count() == 0) {
      if (!was_given) continue;
      for (const std::string& result : before) option->add_result(result);
      option->run_callback();
      continue;
    }
    if (may_be_another(name) && (was_given || name == "--json" || name == "--every-seconds")) continue;
    const std::string now = joined(option->results()), then = was_given ? joined(before) : option->get_default_str();
    if (now != then)
      throw InputError("--resume: '" + file + "' was written " + shown(*option, then) + ", and the command is " +
                       shown(*option, now));
  }
}

}  // namespace hbvm::core

#include "json_facts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "hbvm/error.hpp"

namespace hbvm::core {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t most_values = 12, most_letters = 2'000;

Json parsed(const std::string& text, const std::string& file) {
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    const std::size_t at = std::min(error.byte, text.size());
    const auto lines = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    throw InputError(fmt::format("{}:{}: no JSON: {}", file, lines + 1, error.what()));
  }
}

std::string text_of(const Json& json) {
  std::string text =
      json.is_string() ? json.get<std::string>() : json.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (text.size() > most_letters) text = text.substr(0, most_letters) + " …";
  return text;
}

void gather(std::vector<Fact>& facts, const std::string& name, const Json& json) {
  if (json.is_object()) {
    for (const auto& [key, value] : json.items()) gather(facts, name.empty() ? key : name + "." + key, value);
    return;
  }
  if (!json.is_array()) {
    facts.push_back({name, {text_of(json)}});
    return;
  }
  const bool plain = std::none_of(json.begin(), json.end(), [](const Json& e) { return e.is_structured(); });
  if (json.size() > most_values) {
    facts.push_back({name, {fmt::format("{} entries", json.size())}});
  } else if (plain) {
    if (!json.empty()) facts.push_back({name, {text_of(json)}});
  } else {
    for (std::size_t i = 0; i < json.size(); ++i) gather(facts, fmt::format("{}[{}]", name, i), json[i]);
  }
}

std::string word(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

}  // namespace

void add_fact(std::vector<Fact>& facts, const Fact& fact) {
  auto known = std::find_if(facts.begin(), facts.end(), [&](const Fact& f) { return f.name == fact.name; });
  if (known == facts.end()) known = facts.insert(known, {fact.name, {}});
  for (const std::string& value : fact.values)
    if (known->values.size() < most_values &&
        std::find(known->values.begin(), known->values.end(), value) == known->values.end())
      known->values.push_back(value);
}

bool is_provenance(const std::string& name) {
  static const std::set<std::string> names{"version", "command", "scene",    "method", "precision",
                                           "step",    "until",   "quantity", "digits"};
  return names.contains(name);
}

std::vector<Fact> read_facts(const std::string& text, const std::string& file) {
  std::vector<Fact> facts;
  const Json json = parsed(text, file);
  gather(facts, json.is_object() ? "" : "entries", json);
  return facts;
}

Description read_description(const std::string& text, const std::string& file) {
  const Json json = parsed(text, file);
  if (!json.is_object()) throw InputError(file + ":1: no object that describes a CSV file");
  Description description{word(json, "dc:title"), word(json, "dc:source"), {}, {}};
  for (const auto& [key, value] : json.items())
    if (key.starts_with("hbvm:")) description.facts.push_back({key.substr(5), {text_of(value)}});
  const auto schema = json.find("tableSchema");
  if (schema == json.end() || !schema->is_object() || !schema->contains("columns")) return description;
  for (const Json& column : (*schema)["columns"]) {
    const std::string meaning = column.is_object() ? word(column, "dc:description") : "";
    if (!meaning.empty()) description.columns[word(column, "titles")] = meaning;
  }
  return description;
}

void check_json(const std::string& text, const std::string& file) { parsed(text, file); }

}  // namespace hbvm::core

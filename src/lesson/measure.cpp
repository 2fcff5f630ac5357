#include "lesson/measure.hpp"

#include <algorithm>

namespace hbvm::core {
namespace {

const std::vector<std::string>& kinds() {
  static const std::vector<std::string> kinds{"run", "compare", "convergence", "audit", "reference"};
  return kinds;
}

bool flag(TomlTable& request, std::string_view key) {
  const toml::node* const node = request.take(key);
  if (!node) return false;
  if (!node->is_boolean()) request.fail(*node, std::string(key) + " must be true or false");
  return node->as_boolean()->get();
}

/// Each {blank} becomes its answer. What was put in is not looked at again.
void fill(std::string& text, const Answers& answers) {
  for (std::size_t at = text.find('{'); at != std::string::npos; at = text.find('{', at + 1))
    for (const auto& [blank, answer] : answers)
      if (const std::string place = "{" + blank + "}"; text.compare(at, place.size(), place) == 0) {
        text.replace(at, place.size(), answer);
        at += answer.size() - 1;  // answers are not empty
        break;
      }
}

}  // namespace

NamedTexts named_texts(TomlTable& table, std::string_view key) {
  NamedTexts texts;
  const toml::node* const node = table.take(key);
  if (!node) return texts;
  const toml::table* const named = node->as_table();
  if (!named) table.fail(*node, std::string(key) + " must be a table of texts");
  for (const auto& [name, text] : *named) texts.emplace_back(name.str(), table.to_string(text, std::string(key)));
  return texts;
}

Measure read_measure(const TomlSource& source, const toml::table& table, const std::string& what) {
  TomlTable measure(source, table, what);
  Measure result;
  result.values = named_texts(measure, "values");
  if (result.values.empty()) measure.missing({"values"});
  measure.rename(what + " '" + result.values.front().first + "'");
  for (const std::string& kind : kinds())
    if (measure.has(kind)) result.kind = kind;
  if (result.kind.empty()) measure.missing(kinds());
  const toml::node& node = measure.require(result.kind);
  const toml::table* const asked = node.as_table();
  if (!asked) measure.fail(node, result.kind + " must be a table");
  measure.finish();

  TomlTable request(source, *asked, measure.what() + ", " + result.kind);
  if (result.kind == "audit") {
    result.tableau = request.string("tableau");
    request.finish();
    return result;
  }
  result.scene = request.string("scene");
  result.until = request.string("until");
  result.set = named_texts(request, "set");
  if (result.kind == "reference") {
    result.digits = request.optional_string("digits");
    request.finish();
    return result;
  }
  result.precision = request.optional_string("precision");
  if (result.kind == "run")
    result.methods = {request.string("method")};
  else
    result.methods = request.strings("methods");
  if (result.kind == "convergence")
    result.steps = request.string("steps");
  else
    result.step = request.optional_string("step");
  if (result.kind == "run") {
    result.error = flag(request, "error");
    result.reverse = flag(request, "reverse");
    result.back = flag(request, "back");
  }
  if (result.kind == "compare") result.reference = flag(request, "reference");
  request.finish();
  return result;
}

Measure filled(const Measure& measure, const Answers& answers) {
  Measure result = measure;
  for (std::string* const text :
       {&result.scene, &result.step, &result.until, &result.precision, &result.steps, &result.digits, &result.tableau})
    fill(*text, answers);
  for (std::string& method : result.methods) fill(method, answers);
  for (NamedTexts* const texts : {&result.values, &result.set, &result.files})
    for (auto& [name, text] : *texts) fill(text, answers);
  return result;
}

}  // namespace hbvm::core

#include <gtest/gtest.h>

#include <map>
#include <regex>

#include "verification/cpp_text.hpp"
#include "verification/sources.hpp"

namespace hbvm::core {
namespace {

/// Of a text whose brackets cannot be followed.
constexpr const char* unclosed = "a bracket that is not closed";

/// Without the `template <...>` that it begins with.
std::string without_template(const std::string& head) {
  static const std::regex begins(R"(^\s*template\s*<)");
  std::smatch match;
  if (!std::regex_search(head, match, begins)) return head;
  std::size_t at = static_cast<std::size_t>(match.length());
  for (int depth = 1; depth > 0 && at < head.size(); ++at) depth += head[at] == '<' ? 1 : head[at] == '>' ? -1 : 0;
  return without_template(head.substr(at));
}

/// The name of the type whose body follows `head`; empty if it is another body that does.
std::string type_begun_by(const std::string& head) {
  static const std::regex type(
      R"(^\s*(?:requires\b.*\s)?(?:class|struct|union|enum(?:\s+(?:class|struct))?)\s+)"
      R"((?:\[\[\w+\]\]\s*|alignas\s*\(\w+\)\s*)*(\w+(?:\s*<[^()]*>)?(?:\s*::\s*\w+)*)\s*(?:final\s*)?(?::[^:][^]*)?$)");
  std::smatch match;
  const std::string rest = without_template(head);
  return std::regex_match(rest, match, type) ? std::regex_replace(match[1].str(), std::regex(R"(\s+)"), "") : "";
}

/// C++ text with the lines of its preprocessor empty.
std::string without_directives(const std::string& text) {
  std::string result;
  bool within = false;
  for (const std::string& line : lines_in(text)) {
    const std::size_t first = line.find_first_not_of(" \t");
    const bool directive = within || (first != std::string::npos && line[first] == '#');
    within = directive && line.ends_with('\\');
    result += (directive ? std::string() : line) + '\n';
  }
  return result;
}

/// The types that are defined in C++ text, outside functions, other types and unnamed namespaces:
/// "hbvm::Expression::Node", "std::hash<hbvm::core::Quad>".
std::vector<Occurrence> definitions(const std::string& source) {
  static const std::regex name_space(R"(^\s*(?:inline\s+)?namespace\b\s*([\w:]*)\s*$)");
  const std::string text = without_directives(only(CppPart::code, source));
  std::vector<Occurrence> result;
  std::vector<std::string> open;  // the namespaces around, and " " for each other body
  std::size_t line = 1;
  std::string head;  // since the last statement or body
  for (const char c : text) {
    line += c == '\n';
    if (c != '{' && c != '}' && c != ';') {
      head += c;
      continue;
    }
    if (c == '}' && !open.empty()) open.pop_back();
    if (c == '{') {
      const bool named = std::none_of(open.begin(), open.end(), [](const auto& o) { return o.empty() || o == " "; });
      std::smatch match;
      const bool is_space = std::regex_match(head, match, name_space);
      const std::string type = named && !is_space ? type_begun_by(head) : std::string();
      if (!type.empty()) {
        std::string name;
        for (const std::string& space : open) name += space + "::";
        result.push_back({line, name + type});
      }
      open.push_back(is_space ? match[1].str() : " ");
    }
    head.clear();
  }
  if (!open.empty()) result.push_back({line, unclosed});
  return result;
}

TEST(OneDefinition, TypesAreFoundByTheSearch) {
  const auto found = [](const std::string& text) { return listed(definitions(text)); };
  EXPECT_EQ(found("namespace a {\nstruct B {\n struct C {};\n};\nclass D;\nclass E final : public B {};\n}"),
            "2:a::B 6:a::E ");
  EXPECT_EQ(found("namespace a {\nnamespace {\nstruct B {};\n}\nstruct C : D<int> {};\n}\nstruct E {};"),
            "5:a::C 7:E ");
  EXPECT_EQ(found("template <class S, class T = std::vector<S>>\nstruct B {}; template <> struct B<int, int> {};"),
            "2:B 2:B<int,int> ");
  EXPECT_EQ(found("namespace a::b { enum class C : std::uint8_t { d }; enum E { f }; struct G::H {}; }"),
            "1:a::b::C 1:a::b::E 1:a::b::G::H ");
  EXPECT_EQ(found("void f(B b = {}) { struct C {}; }\nauto g = [] { return struct D{}; };\n// struct E {\n"), "");
  EXPECT_EQ(found("#define F struct G { \\\n };\ntemplate <class T> requires std::integral<T> struct H {};"), "3:H ");
  EXPECT_EQ(found("template <class T>\nclass A<T>::B {};\nclass [[nodiscard]] C {}; union D {};"),
            "2:A<T>::B 3:C 3:D ");
}

/// Two types of one name in a namespace are one to the linker, which keeps the members of one of them for both. Types
/// that one file alone needs stand in an unnamed namespace.
TEST(OneDefinition, OfEachTypeInANamespace) {
  std::map<std::string, std::vector<std::string>> places;  // by name
  for (const char* root : {"src", "include", "tests"})
    for (const Source& source : sources_in(root))
      for (const auto& [line, name] : definitions(source.text)) places[name].push_back(source.place(line));
  EXPECT_GT(places.size(), 300u);
  EXPECT_FALSE(places.contains(unclosed)) << places[unclosed].front();
  EXPECT_TRUE(places.contains("hbvm::core::Precision"));
  for (const auto& [name, where] : places) {
    std::string all;
    for (const std::string& place : where) all += "\n  " + place;
    EXPECT_EQ(where.size(), 1u) << name << " is defined in" << all;
  }
}

}  // namespace
}  // namespace hbvm::core

#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>

#include "audit/claim.hpp"
#include "verification/cpp_text.hpp"
#include "verification/sources.hpp"

namespace hbvm::core {
namespace {

namespace fs = std::filesystem;

// Not by `project`: among variables of two files none need come first.
const fs::path index_file = fs::path(HBVM_SOURCE_DIR) / "studies/equations.md";

/// Pages with tables in which numbers in brackets are no equations.
const std::set<fs::path> tables{"studies/scenes/README.md", "studies/what_accuracy_costs/README.md",
                                "studies/what_accuracy_costs/summary.md"};

/// An equation, which has no kind, or "Theorem" 1.
struct Number {
  std::string kind;
  int value = 0;

  auto operator<=>(const Number&) const = default;
  std::string text() const {
    return kind.empty() ? "(" + std::to_string(value) + ")" : kind + " " + std::to_string(value);
  }
};

/// A line of the index. One of its words stands beside a citation. It also has the name of a claim of the audit, and
/// files that cite it.
struct Entry {
  std::vector<std::string> words;
  std::string claim;
  std::vector<std::string> files;
};

std::vector<std::string> split(const std::string& text, const std::string& separator) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(separator, at), text.size());
    parts.push_back(text.substr(at, end - at));
    at = end + separator.size();
  }
  return parts;
}

/// (54), Theorem 1, Theorems 5 and 9, Corollaries 2, 3; of (67)-(70) the first has the second as `until`.
struct Citation {
  std::size_t line;
  Number number, until;
};

std::vector<Citation> citations(const std::string& prose) {
  static const std::regex pattern(
      R"(\((\d{1,3})\)(?![A-Za-z0-9])|\b(Theorem|Lemma|Corollar|Remark)(?:s|y|ies)? (\d+)(?:(?:,| and) (\d+))?)");
  std::vector<Citation> result;
  std::size_t number = 0;
  for (const std::string& line : split(prose, "\n")) {
    ++number;
    std::ptrdiff_t last_end = -1;
    for (std::sregex_iterator found(line.begin(), line.end(), pattern), end; found != end; ++found) {
      const std::smatch& match = *found;
      if (!match[1].matched) {
        const std::string kind = match[2] == "Corollar" ? "Corollary" : match[2].str();
        for (const int group : {3, 4})
          if (match[group].matched) result.push_back({number, {kind, std::stoi(match[group])}, {}});
        continue;
      }
      // Not the argument of a function.
      const char before = match.position() > 0 ? line[static_cast<std::size_t>(match.position()) - 1] : ' ';
      if (std::isalnum(static_cast<unsigned char>(before)) != 0 ||
          std::string("_'])}").find(before) != std::string::npos)
        continue;
      const Number cited{"", std::stoi(match[1])};
      if (before == '-' && last_end + 1 == match.position() && !result.empty()) result.back().until = cited;
      result.push_back({number, cited, {}});
      last_end = match.position() + match.length();
    }
  }
  return result;
}

std::map<Number, Entry> read_index() {
  std::map<Number, Entry> entries;
  for (const std::string& line : lines_in(read_file(index_file))) {
    if (!line.starts_with("| ") || line.starts_with("| |")) continue;
    const auto cells = split(line.substr(2), " | ");
    const auto printed = citations(cells[0]);
    const bool is_equation = printed.size() == 1 && printed[0].number.kind.empty();
    if (printed.size() != 1 || cells.size() != (is_equation ? 4 : 5)) {
      ADD_FAILURE() << index_file << " has a line of " << cells.size() << " cells: " << line;
      continue;
    }
    Entry entry{split(cells[1], ", "), "", {}};
    if (!is_equation && cells[2] != "–") entry.words.push_back(entry.claim = cells[2]);
    for (const std::string& file : split(cells.back().substr(0, cells.back().find(" |")), ", ")) {
      if (file == "–") continue;
      entry.files.push_back(file.starts_with("studies/") ? file : "src/" + file);
    }
    EXPECT_TRUE(entries.emplace(printed[0].number, entry).second) << cells[0] << " twice";
  }
  return entries;
}

/// Whether a text has the word, from its beginning on and, if it is a symbol of three letters or less, to its end.
bool has_word(const std::string& text, const std::string& word) {
  const auto goes_on = [&](std::size_t at) {
    return at < text.size() && (std::isalnum(static_cast<unsigned char>(text[at])) != 0 || text[at] == '_');
  };
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; ++at)
    if ((at == 0 || !goes_on(at - 1)) && (word.size() > 3 || !goes_on(at + word.size()))) return true;
  return false;
}

TEST(Citations, AreFoundByTheSearch) {
  const auto found = [](const std::string& code) {
    std::string all;
    for (const Citation& c : citations(only(CppPart::prose, code)))
      all += std::to_string(c.line) + ":" + c.number.text() + (c.until.value > 0 ? ".." + c.until.text() : "") + " ";
    return all;
  };
  EXPECT_EQ(found("int a(29);  // by (29), not f(29) nor psi'(0)\n/* Theorem 1 */"), "1:(29) 2:Theorem 1 ");
  EXPECT_EQ(found("f(\"(55)\", R\"(29)\", '\"'); (21) + 1'000; // (2k), (1.5), (3)rd"), "1:(55) ");
  EXPECT_EQ(found("/// (58)-(60): Theorems 5 and 9, Corollaries 2, 3"),
            "1:(58)..(60) 1:(60) 1:Theorem 5 1:Theorem 9 1:Corollary 2 1:Corollary 3 ");
}

TEST(Citations, StandBesideWords) {
  EXPECT_TRUE(has_word("the multipliers", "multiplier"));
  EXPECT_TRUE(has_word("|g|", "g"));
  for (const char* text : {"grad U", "energy_g", "g_a", "a submultiplier"}) {
    EXPECT_FALSE(has_word(text, "g")) << text;
    EXPECT_FALSE(has_word(text, "multiplier")) << text;
  }
}

/// As LaTeX counts: equations, theorems and the rest each from 1 on. Not every remark of the paper is listed.
TEST(EquationIndex, NumbersEveryEquationOnce) {
  std::map<std::string, int> last;
  for (const auto& [number, entry] : read_index()) {
    int& before = last[number.kind];
    if (number.kind != "Remark") {
      EXPECT_EQ(number.value, before + 1) << number.text();
    }
    before = number.value;
  }
  EXPECT_EQ(last,
            (std::map<std::string, int>{{"", 70}, {"Theorem", 10}, {"Lemma", 3}, {"Corollary", 3}, {"Remark", 3}}));
}

struct Text {
  fs::path path;
  std::string prose;                 ///< what the project says: comments and strings of C++, all of other files
  std::vector<std::string> lines{};  ///< of the file
};

const std::vector<Text>& texts() {
  static const std::vector<Text> all = [] {
    std::vector<Text> result;
    const auto add = [&](const fs::path& path) {
      const std::string extension = path.extension().string();
      const bool cpp = extension == ".hpp" || extension == ".cpp" || extension == ".in";
      if (!cpp && extension != ".md" && extension != ".toml") return;
      if (path.filename() == "equations_test.cpp" || path == index_file) return;
      const std::string text = read_file(path);
      result.push_back({path, cpp ? only(CppPart::prose, text) : text, split(text, "\n")});
    };
    add(project / "README.md");
    for (const char* folder : {"include", "src", "tests", "studies"})
      for (auto entry = fs::recursive_directory_iterator(project / folder); entry != fs::end(entry); ++entry) {
        // Tables and what a study writes hold figures.
        if (std::set<fs::path>{"tables", "results", "audit-results", "store"}.contains(entry->path().filename()))
          entry.disable_recursion_pending();
        else if (entry->is_regular_file())
          add(entry->path());
      }
    return result;
  }();
  return all;
}

/// A number alone may be a slip of the pen. Beside it, in its line or the next on either side, is a word of what it is
/// of.
TEST(EquationIndex, KnowsAllThatTheSourcesCiteAndWhatItIsOf) {
  const auto index = read_index();
  std::size_t cited = 0;
  for (const Text& text : texts())
    for (const Citation& citation : citations(text.prose)) {
      if (citation.number.kind.empty() && tables.contains(text.path.lexically_relative(project))) continue;
      const std::string place =
          text.path.string() + ":" + std::to_string(citation.line) + ": " + citation.number.text();
      const auto entry = index.find(citation.number);
      if (entry == index.end()) {
        ADD_FAILURE() << place << " is not in studies/equations.md";
        continue;
      }
      ++cited;
      std::string beside;
      for (std::size_t line = citation.line - std::min<std::size_t>(citation.line, 2);
           line < std::min(citation.line + 1, text.lines.size()); ++line)
        beside += text.lines[line] + "\n";
      const auto& words = entry->second.words;
      EXPECT_TRUE(std::any_of(words.begin(), words.end(), [&](const auto& word) { return has_word(beside, word); }))
          << place << " has none of the words beside it that studies/equations.md has of it";
    }
  EXPECT_GT(cited, 150u);
}

/// Whether a text cites an equation, within (58)-(60), or as the name of a claim: "evaik, polynomial".
bool cites(const std::string& prose, const Number& number, const Entry& entry) {
  for (const Citation& citation : citations(prose))
    if (citation.number == number || (citation.number < number && number <= citation.until)) return true;
  const std::string quoted = "\"" + entry.claim;
  for (std::size_t at = 0; !entry.claim.empty() && (at = prose.find(quoted, at)) != std::string::npos; ++at)
    if (std::isalnum(static_cast<unsigned char>(prose[at + quoted.size()])) == 0) return true;
  return false;
}

/// Tables of claims say where the paper prints them.
TEST(EquationIndex, IsWhatClaimsCite) {
  EXPECT_EQ(readable("hidcons"), "(15) (hidcons)");
  std::size_t named = 0;
  for (const auto& [number, entry] : read_index()) {
    if (entry.claim.empty()) continue;
    ++named;
    EXPECT_EQ(readable(entry.claim), number.text() + " (" + entry.claim + ")");
  }
  EXPECT_EQ(named, 12u);
}

TEST(EquationIndex, NamesFilesThatCite) {
  std::map<fs::path, std::string> prose;
  for (const Text& text : texts()) prose[text.path] = text.prose;
  std::size_t named = 0;
  for (const auto& [number, entry] : read_index())
    for (const std::string& file : entry.files) {
      ++named;
      const auto text = prose.find(project / file);
      if (text == prose.end())
        ADD_FAILURE() << number.text() << ": there is no " << file;
      else
        EXPECT_TRUE(cites(text->second, number, entry)) << file << " does not cite " << number.text();
    }
  EXPECT_GT(named, 70u);
}

}  // namespace
}  // namespace hbvm::core

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "audit/claim.hpp"
#include "read_file.hpp"
#include "verification/cpp_text.hpp"
#include "verification/sources.hpp"

namespace hbvm {
namespace {

namespace fs = std::filesystem;

// Not by `project`: among variables of two files none need come first.
const fs::path index_file = fs::path(HBVM_SOURCE_DIR) / "studies/equations.md";

/// Words in brackets that are no labels.
const std::set<std::string> ordinary{"CSV",     "Interrupted", "SVG",   "default",   "definite", "even",
                                     "formula", "hinge",       "left",  "middle",    "nearly",   "odd",
                                     "once",    "optional",    "right", "symmetric", "twice",    "wall"};

/// A line of the index: dispro1, "(54)" or "Theorem 1", and the files that must cite it.
struct Entry {
  std::string label, printed;
  std::vector<std::string> files;

  bool is_equation() const { return printed.starts_with('('); }
  /// "Theorem" of "Theorem 1".
  std::string kind() const { return is_equation() ? std::string() : printed.substr(0, printed.find(' ')); }
  int number() const { return std::stoi(printed.substr(is_equation() ? 1 : printed.find(' ') + 1)); }
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

std::vector<Entry> read_index() {
  std::vector<Entry> entries;
  std::istringstream lines(read_file(index_file));
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("| ") || line.starts_with("| label")) continue;
    const auto cells = split(line.substr(2), " | ");
    if (cells.size() != 4) {
      ADD_FAILURE() << index_file << " has a line of " << cells.size() << " cells: " << line;
      continue;
    }
    Entry entry{cells[0], cells[1], {}};
    for (const std::string& file : split(cells[3].substr(0, cells[3].find(" |")), ", ")) {
      if (file == "–") continue;
      entry.files.push_back(file.starts_with("studies/") ? file : "src/" + file);
    }
    entries.push_back(entry);
  }
  return entries;
}

/// (dispro1), (Theorem lamex); of (tetH)-(p0) the first has the second as `until`.
struct Citation {
  std::size_t line;
  std::string kind, label, until;
};

/// One word in brackets, of two letters or more, and not the argument of a function.
std::vector<Citation> citations(const std::string& prose) {
  const auto is_word = [](const std::string& text) {
    return text.size() > 1 && std::isalpha(static_cast<unsigned char>(text[0])) != 0 &&
           std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c) != 0; });
  };
  std::vector<Citation> result;
  std::size_t line = 1, last_end = 0;
  for (std::size_t at = 0; at < prose.size(); ++at) {
    line += prose[at] == '\n';
    if (prose[at] != '(') continue;
    const char before = at > 0 ? prose[at - 1] : ' ';
    if (std::isspace(static_cast<unsigned char>(before)) == 0 &&
        std::string("\"(-|*").find(before) == std::string::npos)
      continue;
    const std::size_t end = prose.find_first_of("()\n", at + 1);
    if (end == std::string::npos || prose[end] != ')') continue;
    if (end + 1 < prose.size() && std::isalnum(static_cast<unsigned char>(prose[end + 1])) != 0) continue;  // (un)like
    auto words = split(prose.substr(at + 1, end - at - 1), " ");
    std::string kind;
    if (words.size() == 2 && std::set<std::string>{"Theorem", "Lemma", "Corollary", "Remark"}.contains(words[0])) {
      kind = words[0];
      words.erase(words.begin());
    }
    if (words.size() != 1 || !is_word(words[0])) continue;
    if (before == '-' && last_end + 2 == at && !result.empty()) result.back().until = words[0];
    result.push_back({line, kind, words[0], {}});
    last_end = end;
  }
  return result;
}

TEST(Citations, AreFoundByTheSearch) {
  const auto found = [](const std::string& code) {
    std::string all;
    for (const Citation& c : citations(only(CppPart::prose, code)))
      all += std::to_string(c.line) + ":" + (c.kind.empty() ? "" : c.kind + " ") + c.label +
             (c.until.empty() ? "" : ".." + c.until) + " ";
    return all;
  };
  EXPECT_EQ(found("int a(lam);  // by (lam), not f(lam) nor psi'(lam)\n/* (Theorem lamex) */"),
            "1:lam 2:Theorem lamex ");
  EXPECT_EQ(found("f(\"(iter)\", R\"(lam)\", '\"'); (lim) + 1'000; // (lim1)"), "1:iter 1:lim1 ");
  EXPECT_EQ(found("/// (pend)-(pend0): (q, p) (t) (2k + 1) (Hqp) (sub)step"), "1:pend..pend0 1:pend0 1:Hqp ");
}

/// As LaTeX counts: equations, theorems and the rest each from 1 on. Not every remark of the paper has a label.
TEST(EquationIndex, NumbersEveryEquationOnce) {
  std::set<std::string> labels;
  std::map<std::string, int> last;
  for (const Entry& entry : read_index()) {
    EXPECT_TRUE(labels.insert(entry.label).second) << entry.label << " twice";
    int& before = last[entry.kind()];
    if (entry.kind() == "Remark") {
      EXPECT_GT(entry.number(), before) << entry.label;
    } else {
      EXPECT_EQ(entry.number(), before + 1) << entry.label;
    }
    before = entry.number();
  }
  EXPECT_EQ(last,
            (std::map<std::string, int>{{"", 70}, {"Theorem", 10}, {"Lemma", 3}, {"Corollary", 3}, {"Remark", 3}}));
}

struct Text {
  fs::path path;
  std::string prose;
};

/// What the project says: comments and strings of C++, and all other text.
const std::vector<Text>& texts() {
  static const std::vector<Text> all = [] {
    std::vector<Text> result;
    const auto add = [&](const fs::path& path) {
      const std::string extension = path.extension().string();
      const bool cpp = extension == ".hpp" || extension == ".cpp" || extension == ".in";
      if (!cpp && extension != ".md" && extension != ".toml") return;
      if (path.filename() == "equations_test.cpp") return;
      result.push_back({path, cpp ? only(CppPart::prose, read_file(path)) : read_file(path)});
    };
    add(project / "README.md");
    for (const char* folder : {"include", "src", "tests", "studies"})
      for (auto entry = fs::recursive_directory_iterator(project / folder); entry != fs::end(entry); ++entry) {
        // Tables and what a study writes hold figures.
        if (std::set<fs::path>{"tables", "results", "audit-results"}.contains(entry->path().filename()))
          entry.disable_recursion_pending();
        else if (entry->is_regular_file())
          add(entry->path());
      }
    return result;
  }();
  return all;
}

TEST(EquationIndex, KnowsAllThatTheSourcesCite) {
  std::map<std::string, Entry> index;
  for (const Entry& entry : read_index()) index[entry.label] = entry;
  std::size_t cited = 0;
  for (const Text& text : texts())
    for (const Citation& citation : citations(text.prose)) {
      const std::string place = text.path.string() + ":" + std::to_string(citation.line) + ": ";
      const auto entry = index.find(citation.label);
      if (entry == index.end()) {
        EXPECT_TRUE(citation.kind.empty() && ordinary.contains(citation.label))
            << place << "(" << citation.label << ") is no label of studies/equations.md, nor in the list of ordinary "
            << "words of this test";
        continue;
      }
      ++cited;
      if (!citation.kind.empty()) {
        EXPECT_EQ(citation.kind, entry->second.kind()) << place << citation.label;
      }
    }
  EXPECT_GT(cited, 100u);
}

/// Whether a text cites an equation in brackets, within (a)-(b), or as the name of a claim: "evaik, polynomial".
bool cites(const std::string& prose, const Entry& entry, const std::map<std::string, Entry>& index) {
  for (const Citation& citation : citations(prose)) {
    if (citation.label == entry.label) return true;
    const auto from = index.find(citation.label), to = index.find(citation.until);
    if (from != index.end() && to != index.end() && from->second.kind() == entry.kind() &&
        from->second.number() <= entry.number() && entry.number() <= to->second.number())
      return true;
  }
  const std::string quoted = "\"" + entry.label;
  for (std::size_t at = 0; (at = prose.find(quoted, at)) != std::string::npos; ++at)
    if (std::isalnum(static_cast<unsigned char>(prose[at + quoted.size()])) == 0) return true;
  return false;
}

/// Tables of claims say where the paper prints them.
TEST(EquationIndex, IsWhatClaimsCite) {
  std::size_t cited = 0;
  for (const Entry& entry : read_index()) {
    const std::string text = readable(entry.label);
    if (text == entry.label) continue;
    ++cited;
    EXPECT_EQ(text, entry.printed + " (" + entry.label + ")");
  }
  EXPECT_EQ(cited, 13u);
}

TEST(EquationIndex, NamesFilesThatCite) {
  const auto entries = read_index();
  std::map<std::string, Entry> index;
  for (const Entry& entry : entries) index[entry.label] = entry;
  std::map<fs::path, std::string> prose;
  for (const Text& text : texts()) prose[text.path] = text.prose;
  std::size_t named = 0;
  for (const Entry& entry : entries)
    for (const std::string& file : entry.files) {
      ++named;
      const auto text = prose.find(project / file);
      if (text == prose.end())
        ADD_FAILURE() << entry.label << ": there is no " << file;
      else
        EXPECT_TRUE(cites(text->second, entry, index)) << file << " does not cite (" << entry.label << ")";
    }
  EXPECT_GT(named, 70u);
}

}  // namespace
}  // namespace hbvm

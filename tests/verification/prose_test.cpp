#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "verification/cpp_text.hpp"
#include "verification/sources.hpp"

namespace hbvm::core {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t lines_of_the_first_page = 110, words_on_a_page = 40, words_in_a_comment = 25;

/// A piece of text whose sentences do not go on elsewhere: a paragraph, an entry of a list, a cell of a table.
struct Passage {
  std::size_t line = 0;
  std::string text;
};

/// Passages line by line.
class Passages {
 public:
  void end() {
    if (!open_.text.empty()) done_.push_back(open_);
    open_ = {};
  }
  void add(std::size_t line, const std::string& text) {
    if (open_.text.empty()) open_.line = line;
    open_.text += " " + text;
  }
  void alone(std::size_t line, const std::string& text) {
    end();
    add(line, text);
    end();
  }
  std::vector<Passage> all() && {
    end();
    return std::move(done_);
  }

 private:
  Passage open_;
  std::vector<Passage> done_;
};

bool begins_an_entry(const std::string& line) {
  static const std::regex entry(R"(\s*(?:[-*]|\d+\.)\s.*)");
  return std::regex_match(line, entry);
}

/// Of a page in Markdown: neither code nor commands.
std::vector<Passage> passages_of_page(const std::string& page) {
  Passages result;
  bool code = false, fenced = false, paragraph = false;
  std::size_t number = 0;
  for (const std::string& line : lines_in(page)) {
    ++number;
    if (line.starts_with("```")) fenced = !fenced;
    const bool blank = line.find_first_not_of(' ') == std::string::npos;
    code = line.starts_with("    ") && !paragraph;
    if (blank || fenced || line.starts_with("```") || code) {
      result.end();
    } else if (line.find_first_not_of(' ') == line.find('|')) {
      std::istringstream cells(std::regex_replace(line, std::regex(R"(\\\|)"), " "));
      for (std::string cell; std::getline(cells, cell, '|');) result.alone(number, cell);
    } else {
      if (begins_an_entry(line) || line.starts_with("#")) result.end();
      result.add(number, line);
    }
    paragraph = !blank && !code;
  }
  return std::move(result).all();
}

/// Of the comments of C++: formulas and lists that are set off stand by themselves.
std::vector<Passage> passages_of_comments(const std::string& source) {
  static const std::regex marks(R"(^\s*//[/!]?<?)");
  Passages result;
  std::size_t number = 0, column_before = std::string::npos;
  std::istringstream comments(only(CppPart::comments, source)), whole(source);
  for (std::string comment, line; std::getline(comments, comment) && std::getline(whole, line);) {
    ++number;
    const std::size_t column = comment.find_first_not_of(' ');
    const bool after_code = line.find_first_not_of(' ') < column;
    if (column != column_before || after_code) result.end();
    column_before = column;
    if (column == std::string::npos) continue;
    const std::string text = std::regex_replace(comment, marks, "");
    const std::size_t indent = text.find_first_not_of(' ');
    if (indent == std::string::npos || indent >= 4) {
      result.end();
    } else {
      if (begins_an_entry(text) || text[indent] == '\\') result.end();
      result.add(number, text);
    }
  }
  return std::move(result).all();
}

/// What stands between backquotes is one word, and so is a link's address.
std::string simplified(const std::string& text) {
  static const std::regex code("`[^`]*`"), link(R"(\]\([^)]*\))"), shortened(R"(\b(e\.g|i\.e)\.)");
  return std::regex_replace(std::regex_replace(std::regex_replace(text, code, "Code"), link, ""), shortened, "$1");
}

/// A sentence ends with its mark, unless a word in lower case follows; a formula may begin one.
std::vector<std::string> sentences(const std::string& text) {
  static const std::regex end(R"([.!?][)*"']*\s+(?!\s|[a-z][a-z]+[\s,.;:]|a\s))");
  const std::string simple = simplified(text);
  return {std::sregex_token_iterator(simple.begin(), simple.end(), end, -1), std::sregex_token_iterator()};
}

std::size_t words(const std::string& sentence) {
  std::istringstream stream(sentence);
  std::size_t count = 0;
  for (std::string word; stream >> word;)
    count += std::any_of(word.begin(), word.end(), [](unsigned char c) { return std::isalnum(c) != 0; });
  return count;
}

/// The sentences of more words, each with its place.
std::vector<std::string> too_long(const std::vector<Passage>& passages, std::size_t most, const std::string& file) {
  std::vector<std::string> result;
  for (const Passage& passage : passages)
    for (const std::string& sentence : sentences(passage.text))
      if (words(sentence) > most)
        result.push_back(file + ":" + std::to_string(passage.line) + ": " + std::to_string(words(sentence)) +
                         " words in \"" + sentence + "\"");
  return result;
}

std::string of_words(std::size_t n) {
  std::string text = "One";
  for (std::size_t i = 1; i < n; ++i) text += " word";
  return text;
}

TEST(Prose, LongSentencesOfPagesAreFound) {
  const auto found = [](const std::string& page) { return too_long(passages_of_page(page), 40, "page").size(); };
  EXPECT_EQ(found(of_words(40) + ".\n"), 0u);
  EXPECT_EQ(found(of_words(41) + ".\n"), 1u);
  EXPECT_EQ(found(of_words(20) + "\n" + of_words(21) + ".\n"), 1u) << "goes on in the next line";
  EXPECT_EQ(found(of_words(20) + ".\n" + of_words(21) + ".\n"), 0u);
  EXPECT_EQ(found(of_words(20) + "\n\n" + of_words(21) + "\n"), 0u) << "two paragraphs";
  EXPECT_EQ(found("- " + of_words(30) + "\n- " + of_words(30) + "\n"), 0u) << "two entries";
  EXPECT_EQ(found("- " + of_words(30) + "\n  " + of_words(30) + "\n"), 1u) << "one entry";
  EXPECT_EQ(found("| " + of_words(30) + " | " + of_words(30) + " |\n"), 0u) << "two cells";
  EXPECT_EQ(found("| a | " + of_words(41) + " |\n"), 1u);
  EXPECT_EQ(found("```\n" + of_words(41) + "\n```\n"), 0u) << "code";
  EXPECT_EQ(found("Text:\n\n    " + of_words(41) + "\n"), 0u) << "commands";
  EXPECT_EQ(found(of_words(39) + " `a b c d`.\n"), 0u) << "code is one word";
}

TEST(Prose, LongSentencesOfCommentsAreFound) {
  const auto found = [](const std::string& code) { return too_long(passages_of_comments(code), 25, "code").size(); };
  EXPECT_EQ(found("/// " + of_words(25) + ".\nint x;\n"), 0u);
  EXPECT_EQ(found("/// " + of_words(26) + ".\nint x;\n"), 1u);
  EXPECT_EQ(found("// " + of_words(13) + "\n// " + of_words(13) + "\n"), 1u);
  EXPECT_EQ(found("int x;  ///< " + of_words(13) + "\n        ///< " + of_words(13) + "\n"), 1u);
  EXPECT_EQ(found("int x;  ///< " + of_words(13) + "\nint y;  ///< " + of_words(13) + "\n"), 0u) << "of two things";
  EXPECT_EQ(found("// " + of_words(13) + "\n\n// " + of_words(13) + "\n"), 0u);
  EXPECT_EQ(found("/// " + of_words(13) + "\n/// \\throws " + of_words(13) + "\n"), 0u);
  EXPECT_EQ(found("///     " + of_words(26) + "\n"), 0u) << "a formula";
  EXPECT_EQ(found("// " + of_words(24) + ". g_1 is one.\n"), 0u) << "begins with a formula";
  EXPECT_EQ(found("// " + of_words(24) + " e.g. one.\n"), 1u);
  EXPECT_EQ(found("text = \"// " + of_words(26) + "\";\n"), 0u) << "a string";
}

TEST(Prose, FirstPageIsShort) { EXPECT_LE(lines_in(read_file(project / "README.md")).size(), lines_of_the_first_page); }

TEST(Prose, PagesHaveShortSentences) {
  std::vector<fs::path> pages{project / "README.md", project / "src/README.md", project / "src/browser/README.md"};
  for (auto entry = fs::recursive_directory_iterator(project / "studies"); entry != fs::end(entry); ++entry) {
    if (entry->path().filename() == "results") entry.disable_recursion_pending();
    if (entry->path().extension() == ".md") pages.push_back(entry->path());
  }
  EXPECT_GT(pages.size(), 15u);
  for (const fs::path& page : pages)
    for (const std::string& sentence : too_long(passages_of_page(read_file(page)), words_on_a_page, page))
      ADD_FAILURE() << sentence;
}

TEST(Prose, CommentsHaveShortSentences) {
  for (const char* root : {"src", "include", "tests"})
    for (const Source& source : sources_in(root))
      for (const std::string& sentence : too_long(passages_of_comments(source.text), words_in_a_comment, source.path))
        ADD_FAILURE() << sentence;
}

/// Lines "| `room` | what is there |" of the table below that heading.
std::vector<std::string> rooms_of_the_page() {
  static const std::regex row(R"(\| `(\w+)` \| .+ \|)");
  std::vector<std::string> rooms;
  bool here = false;
  for (const std::string& line : lines_in(read_file(project / "src/README.md"))) {
    if (line.starts_with("## ")) here = line == "## The rooms";
    std::smatch match;
    if (here && std::regex_match(line, match, row)) rooms.push_back(match[1]);
  }
  return rooms;
}

TEST(Prose, EveryRoomHasALine) {
  std::multiset<std::string> folders, listed;
  for (const auto& entry : fs::directory_iterator(project / "src"))
    if (entry.is_directory()) folders.insert(entry.path().filename().string());
  for (const std::string& room : rooms_of_the_page()) listed.insert(room);
  EXPECT_EQ(listed, folders);
}

}  // namespace
}  // namespace hbvm::core

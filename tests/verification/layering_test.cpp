#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <regex>
#include <set>

#include "verification/sources.hpp"

namespace hbvm::core {
namespace {

using Folders = std::set<std::string>;

/// The folders each folder may include: itself and those to its left. The files in no folder, "", say what is needed
/// everywhere and include none.
std::map<std::string, Folders> allowed() {
  std::map<std::string, Folders> result;
  Folders both_chains{""};
  result[""] = {""};
  for (const std::vector<std::string>& chain :
       {std::vector<std::string>{"scalar", "linear", "basis", "toml", "method", "scheme"},
        {"scalar", "linear", "problem", "toml", "scene"}}) {
    Folders left{""};
    for (const std::string& folder : chain) {
      left.insert(folder);
      result[folder].insert(left.begin(), left.end());
    }
    both_chains.merge(left);
  }
  for (const char* folder : {"solver", "step", "integrate", "reference"}) {
    both_chains.insert(folder);
    result[folder] = both_chains;
  }
  result["report"] = {"", "report"};
  result["long_work"] = {"", "long_work"};
  both_chains.insert({"report", "long_work"});
  for (const char* folder : {"run", "audit", "compare", "cost", "study", "section", "lesson", "door"}) {
    both_chains.insert(folder);
    result[folder] = both_chains;
  }
  result["python"] = {"", "python"};
  result["processes"] = {"", "report", "long_work", "processes"};
  result["folder_report"] = {"", "report", "folder_report"};
  both_chains.insert({"processes", "folder_report"});
  for (const char* folder : {"hard_cases", "cli"}) {
    both_chains.insert(folder);
    result[folder] = both_chains;
  }
  return result;
}

/// Lines of #include: number, whether in quotes, and the file.
struct Include {
  std::size_t line;
  bool quoted;
  std::string file;
};
std::vector<Include> includes(const std::string& text) {
  static const std::regex pattern(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"].*)");
  std::vector<Include> result;
  std::size_t number = 0;
  for (const std::string& line : lines_in(text)) {
    ++number;
    std::smatch match;
    if (std::regex_match(line, match, pattern)) result.push_back({number, match[1] == "\"", match[2]});
  }
  return result;
}

TEST(Layering, HasAPlaceForEveryFolder) {
  const auto folders = allowed();
  for (const Source& source : sources())
    EXPECT_TRUE(folders.contains(source.folder)) << source.path << " is in no layer";
}

/// "problem" for "problem/effect/trace.hpp", "" for "error.hpp".
std::string folder_of(const std::string& file) {
  return file.find('/') == std::string::npos ? std::string() : file.substr(0, file.find('/'));
}

TEST(Layering, IncludesGoOnlyLeftwards) {
  const auto folders = allowed();
  std::size_t seen = 0;
  for (const Source& source : sources()) {
    if (!folders.contains(source.folder)) continue;
    for (const Include& include : includes(source.text)) {
      if (!include.quoted || include.file.starts_with("hbvm/")) continue;  // what all may know
      ++seen;
      std::string folder = source.folder;
      if (!std::filesystem::exists(source.path.parent_path() / include.file)) folder = folder_of(include.file);
      EXPECT_TRUE(folders.at(source.folder).contains(folder))
          << source.place(include.line) << ": " << source.folder << " must not include " << include.file;
    }
  }
  EXPECT_GT(seen, 100u);
}

/// The folder a file of src is in, "problem/effect", and where a line of it that includes another leads.
std::filesystem::path whole_folder(const Source& source) {
  return source.path.lexically_relative(project / "src").parent_path();
}
std::filesystem::path target(const Source& source, const std::string& file) {
  const bool beside = std::filesystem::exists(source.path.parent_path() / file);
  return beside ? (whole_folder(source) / file).lexically_normal().parent_path()
                : std::filesystem::path(file).parent_path();
}

/// Folders within folders stand in an order, too: none is reached again from what it includes.
TEST(Layering, FoldersWithinFoldersFormNoCircle) {
  std::map<std::string, std::map<std::string, std::string>> includes_of;  // folder, folder: one place
  for (const Source& source : sources())
    for (const Include& include : includes(source.text)) {
      const bool own = include.quoted && !include.file.starts_with("hbvm/");
      const std::string from = whole_folder(source).generic_string(),
                        to = own ? target(source, include.file).generic_string() : from;
      if (from != to) includes_of[from].emplace(to, source.place(include.line) + " includes " + include.file);
    }
  EXPECT_TRUE(includes_of["problem"].contains("problem/effect"));
  for (const auto& [start, unused] : includes_of) {
    std::map<std::string, std::string> reached{{start, ""}};
    for (std::vector<std::string> open{start}; !open.empty();) {
      const std::string folder = open.back();
      open.pop_back();
      for (const auto& [next, place] : includes_of[folder]) {
        const std::string path = reached[folder] + "\n  " + place;
        EXPECT_NE(next, start) << "a circle of folders:" << path;
        if (reached.emplace(next, path).second) open.push_back(next);
      }
    }
  }
}

/// What is declared to the left is not defined to the right. The symbols that the object of a folder needs are defined
/// in folders that it may include.
TEST(Layering, DefinitionsStandWhereTheirDeclarationsDo) {
  const std::string command = std::string("nm -A ") + HBVM_LIBRARIES;
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  ASSERT_TRUE(pipe);
  std::map<std::string, Folders> needed, defined;  // by symbol: folders
  // libhbvm.a:unity_src_problem_effect_cxx.cxx.o:00000000000000a0 T _ZN4hbvm...
  static const std::regex line_of(
      R"(.*:unity_src_([a-z]+(?:_work|_cases|_report)?)\w*_cxx\.cxx\.o:[0-9a-f ]* ([A-Za-z]) (_ZN?K?\w*4hbvm\w+)\n?)");
  for (char buffer[1 << 16]; std::fgets(buffer, sizeof buffer, pipe.get());) {
    std::cmatch match;
    if (!std::regex_match(buffer, match, line_of)) continue;
    (match[2] == "U" ? needed : defined)[match[3]].insert(match[1]);
  }
  if (needed.empty()) GTEST_SKIP() << "the library's sources are not compiled folder by folder";
  const auto folders = allowed();
  std::size_t seen = 0;
  for (const auto& [symbol, where] : needed) {
    const auto definition = defined.find(symbol);
    if (definition == defined.end()) continue;  // of a generated source, or a library
    for (const std::string& folder : where) {
      if (!folders.contains(folder)) continue;
      ++seen;
      const Folders& left = folders.at(folder);
      const bool is_left = std::any_of(definition->second.begin(), definition->second.end(),
                                       [&](const std::string& f) { return left.contains(f); });
      EXPECT_TRUE(is_left) << folder << " needs " << symbol << ", which " << *definition->second.begin() << " defines";
    }
  }
  EXPECT_GT(seen, 300u);
}

TEST(Layering, ReportsHoldNoScalarType) {
  static const std::regex scalar(R"(\b(Mpfr|Quad|Scalar|PrecisionScope|float128|multiprecision|mpfr_\w+)\b)");
  static const std::regex library(R"(^(boost/multiprecision|quadmath|mpfr|gmp|Eigen).*)");
  for (const Source& source : sources()) {
    if (source.folder != "report" && source.folder != "folder_report") continue;
    std::smatch match;
    EXPECT_FALSE(std::regex_search(source.text, match, scalar)) << source.path << " names " << match.str();
    for (const Include& include : includes(source.text))
      EXPECT_FALSE(std::regex_match(include.file, library))
          << source.place(include.line) << " includes " << include.file;
  }
}

}  // namespace
}  // namespace hbvm::core

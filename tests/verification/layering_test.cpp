#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>

#include "verification/sources.hpp"

namespace hbvm {
namespace {

using Folders = std::set<std::string>;

/// The folders each folder may include: itself and those to its left. The files in no folder, "", say what is needed
/// everywhere and include none.
std::map<std::string, Folders> allowed() {
  std::map<std::string, Folders> result;
  Folders both_chains{""};
  result[""] = {""};
  for (const std::vector<std::string>& chain :
       {std::vector<std::string>{"scalar", "linear", "basis", "toml", "method"},
        {"scalar", "linear", "problem", "toml", "scene"}}) {
    Folders left{""};
    for (const std::string& folder : chain) {
      left.insert(folder);
      result[folder].insert(left.begin(), left.end());
    }
    both_chains.merge(left);
  }
  for (const char* folder : {"solver", "step", "integrate", "reference", "analysis"}) {
    both_chains.insert(folder);
    result[folder] = both_chains;
  }
  result["report"] = {"", "report"};
  result["analysis"].insert("report");  // whose tables it fills
  both_chains.insert({"report", "cli"});
  result["cli"] = both_chains;
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
  std::istringstream lines(text);
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
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
  const std::string own = "hbvm/";
  const auto folders = allowed();
  std::size_t seen = 0;
  for (const Source& source : sources()) {
    if (!folders.contains(source.folder)) continue;
    for (const Include& include : includes(source.text)) {
      if (!include.quoted) continue;
      ++seen;
      std::string folder = source.folder;
      if (include.file.starts_with(own))
        folder = folder_of(include.file.substr(own.size()));
      else if (!std::filesystem::exists(source.path.parent_path() / include.file))
        folder = folder_of(include.file);  // a private header of another folder of src
      EXPECT_TRUE(folders.at(source.folder).contains(folder))
          << source.place(include.line) << ": " << source.folder << " must not include " << include.file;
    }
  }
  EXPECT_GT(seen, 100u);
}

TEST(Layering, ReportsHoldNoScalarType) {
  static const std::regex scalar(R"(\b(Mpfr|Quad|Scalar|PrecisionScope|float128|multiprecision|mpfr_\w+)\b)");
  static const std::regex library(R"(^(boost/multiprecision|quadmath|mpfr|gmp|Eigen).*)");
  for (const Source& source : sources()) {
    if (source.folder != "report") continue;
    std::smatch match;
    EXPECT_FALSE(std::regex_search(source.text, match, scalar)) << source.path << " names " << match.str();
    for (const Include& include : includes(source.text))
      EXPECT_FALSE(std::regex_match(include.file, library))
          << source.place(include.line) << " includes " << include.file;
  }
}

}  // namespace
}  // namespace hbvm

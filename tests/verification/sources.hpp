#pragma once

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "read_file.hpp"

namespace hbvm::core {

inline const std::filesystem::path project = HBVM_SOURCE_DIR;

/// A C++ file of src, include or tests. `folder` is the one below: "problem" for src/problem/effect/trace.cpp.
struct Source {
  std::filesystem::path path;
  std::string folder, text;

  std::string place(std::size_t line) const { return path.string() + ":" + std::to_string(line); }
};

/// All below a folder of the project.
inline std::vector<Source> sources_in(const char* root) {
  namespace fs = std::filesystem;
  std::vector<Source> result;
  const fs::path base = project / root;
  for (const auto& entry : fs::recursive_directory_iterator(base)) {
    const std::string name = entry.path().filename().string();
    if (!name.ends_with(".hpp") && !name.ends_with(".cpp") && !name.ends_with(".cpp.in")) continue;
    const fs::path relative = fs::relative(entry.path(), base);
    const bool in_folder = std::distance(relative.begin(), relative.end()) > 1;
    result.push_back({entry.path(), in_folder ? relative.begin()->string() : std::string(), read_file(entry.path())});
  }
  std::sort(result.begin(), result.end(), [](const Source& a, const Source& b) { return a.path < b.path; });
  return result;
}

/// Of the library and the program.
inline std::vector<Source> sources() { return sources_in("src"); }

inline std::vector<std::string> lines_in(const std::string& text) {
  std::vector<std::string> result;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) result.push_back(line);
  return result;
}

/// What a search finds in a text, and in which line.
struct Occurrence {
  std::size_t line;
  std::string text;
};

/// "1:first 3:second ".
inline std::string listed(const std::vector<Occurrence>& all) {
  std::string result;
  for (const Occurrence& each : all) result += std::to_string(each.line) + ":" + each.text + " ";
  return result;
}

}  // namespace hbvm::core

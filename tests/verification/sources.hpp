#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

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
    std::ifstream file(entry.path());
    std::ostringstream text;
    text << file.rdbuf();
    const bool in_folder = std::distance(relative.begin(), relative.end()) > 1;
    result.push_back({entry.path(), in_folder ? relative.begin()->string() : std::string(), text.str()});
  }
  std::sort(result.begin(), result.end(), [](const Source& a, const Source& b) { return a.path < b.path; });
  return result;
}

/// Of the library and the program.
inline std::vector<Source> sources() { return sources_in("src"); }

}  // namespace hbvm::core

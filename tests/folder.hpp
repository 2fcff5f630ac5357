#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "temporary_folder.hpp"

namespace hbvm::core {

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// A folder for the files of a test, removed with them.
class Folder : public TemporaryFolder {
 public:
  std::string operator/(const std::string& name) const { return file(name); }
  std::string write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((path() / name).parent_path());
    std::ofstream(path() / name, std::ios::binary) << text;
    return *this / name;
  }
};

}  // namespace hbvm::core

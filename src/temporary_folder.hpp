#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "hbvm/error.hpp"

namespace hbvm::core {

/// A folder that is there, with its files, as long as this is.
class TemporaryFolder {
 public:
  /// \throws Error if none can be made
  TemporaryFolder() {
    const std::filesystem::path place = std::filesystem::temp_directory_path();
    std::string name = (place / "hbvm_XXXXXX").string();
    if (!mkdtemp(name.data())) throw Error("cannot create a folder in '" + place.string() + "'");
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string file(const std::string& name) const { return (path_ / name).string(); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace hbvm::core

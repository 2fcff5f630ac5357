#pragma once

#include <string>

namespace hbvm::core {

/// Keeps a regular file, or a folder, from being held so by another process, or elsewhere in this one, until the
/// descriptor is closed. Other files, as pipes, may have several writers.
/// \throws InputError if it is held
void lock_file(int descriptor, const std::string& path);

/// The same for as long as it lives, of a folder, or of a file that it makes if there is none.
class FileLock {
 public:
  /// \throws InputError if it is held, or cannot be
  explicit FileLock(const std::string& path);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int file_;
};

}  // namespace hbvm::core

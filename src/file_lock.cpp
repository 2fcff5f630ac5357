#include "file_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "hbvm/error.hpp"

namespace hbvm::core {

void lock_file(int descriptor, const std::string& path) {
  struct stat status {};
  if (fstat(descriptor, &status) != 0 || !(S_ISREG(status.st_mode) || S_ISDIR(status.st_mode))) return;
  // Where a file system knows no locks, there is none.
  if (flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw InputError("'" + path + "' is being written by another run; wait for its end, or name another");
}

FileLock::FileLock(const std::string& path)
    : file_(std::filesystem::is_directory(path) ? ::open(path.c_str(), O_RDONLY | O_CLOEXEC)
                                                : ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666)) {
  if (file_ < 0) throw InputError("cannot write '" + path + "': " + std::strerror(errno));
  try {
    lock_file(file_, path);
  } catch (...) {
    ::close(file_);
    throw;
  }
}

FileLock::~FileLock() { ::close(file_); }

}  // namespace hbvm::core

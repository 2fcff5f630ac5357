#include "integrate/csv_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "file_lock.hpp"
#include "hbvm/error.hpp"

namespace hbvm::core {
namespace {

constexpr std::size_t buffer_size = 1U << 16U;

}  // namespace

CsvFile::CsvFile(const std::string& path, Opening opening) : std::ostream(nullptr), buffer_(path, opening) {
  rdbuf(&buffer_);
  exceptions(std::ios::badbit);  // those of the buffer reach the caller
}

CsvFile::~CsvFile() {
  try {
    buffer_.write_lines();
  } catch (const InputError&) {  // whoever wanted to know has flushed
  }
}

void CsvFile::remember(Archive& archive) { buffer_.remember(archive); }

CsvFile::Buffer::Buffer(std::string path, Opening opening)
    : path_(std::move(path)),
      file_(
          ::open(path_.c_str(), opening == Opening::anew ? O_WRONLY | O_CREAT | O_CLOEXEC : O_RDWR | O_CLOEXEC, 0666)) {
  if (file_ < 0) fail(std::strerror(errno));
  try {
    lock_file(file_, path_);
  } catch (...) {
    ::close(file_);
    throw;
  }
  if (opening == Opening::anew) cut_to(0);
}

CsvFile::Buffer::~Buffer() { ::close(file_); }

void CsvFile::Buffer::fail(const std::string& what) const { throw InputError("cannot write '" + path_ + "': " + what); }

void CsvFile::Buffer::cut_to(long length) {
  if (ftruncate(file_, length) == 0) lseek(file_, length, SEEK_SET);  // a pipe cannot be cut
}

void CsvFile::Buffer::write_lines() {
  const std::size_t end = pending_.rfind('\n') + 1;  // 0 if there is none
  for (std::size_t done = 0; done < end;) {
    const ssize_t written = ::write(file_, pending_.data() + done, end - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const int why = errno;
      const std::size_t complete = done == 0 ? 0 : pending_.rfind('\n', done - 1) + 1;
      length_ += static_cast<long>(complete);
      pending_.clear();
      cut_to(length_);
      fail(std::string(std::strerror(why)) + "; it ends with the last line that had room");
    }
    done += static_cast<std::size_t>(written);
  }
  length_ += static_cast<long>(end);
  checksum_.add(std::string_view(pending_).substr(0, end));
  pending_.erase(0, end);
}

void CsvFile::Buffer::remember(Archive& archive) {
  if (!archive.reading()) {
    write_lines();
    struct stat status {};
    if (fstat(file_, &status) != 0 || !S_ISREG(status.st_mode))
      throw InputError("--checkpoint: '" + path_ + "' is no file that could be cut and continued");
    if (fdatasync(file_) != 0) fail(std::strerror(errno));
  }
  std::string sum = checksum_.text();
  archive(length_, sum);
  if (!archive.reading()) return;
  std::string part(buffer_size, '\0');
  checksum_ = Checksum();
  for (long left = length_; left > 0;) {
    const ssize_t count = ::read(file_, part.data(), std::min(part.size(), static_cast<std::size_t>(left)));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(std::strerror(errno));
    if (count == 0)
      throw InputError("'" + path_ + "' has " + std::to_string(length_ - left) + " bytes, and had " +
                       std::to_string(length_) + " when the checkpoint was written");
    checksum_.add(std::string_view(part).substr(0, static_cast<std::size_t>(count)));
    left -= count;
  }
  if (checksum_.text() != sum)
    throw InputError("'" + path_ + "' does not begin as it did when the checkpoint was written");
  cut_to(length_);
}

CsvFile::Buffer::int_type CsvFile::Buffer::overflow(int_type c) {
  if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
  const char byte = traits_type::to_char_type(c);
  xsputn(&byte, 1);
  return c;
}

std::streamsize CsvFile::Buffer::xsputn(const char* text, std::streamsize count) {
  pending_.append(text, static_cast<std::size_t>(count));
  if (pending_.size() >= buffer_size) write_lines();
  return count;
}

int CsvFile::Buffer::sync() {
  write_lines();
  return 0;
}

}  // namespace hbvm::core

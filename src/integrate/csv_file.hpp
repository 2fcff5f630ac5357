#pragma once

#include <ostream>
#include <string>

#include "checksum.hpp"
#include "scalar/archive.hpp"

namespace hbvm::core {

/// A text file of lines that always ends with a complete one, also when the disk is full or the process is ended. What
/// is written to it reaches the file in whole lines, and a line that does not fit is taken back.
class CsvFile final : public std::ostream {
 public:
  enum class Opening {
    anew,     ///< empty
    to_go_on  ///< as it is, until remember() cuts it to what it was
  };

  /// \throws InputError if the file cannot be opened, or another run is writing it; to_go_on: if it is not there
  CsvFile(const std::string& path, Opening opening);
  /// Complete lines are still written, if they can be.
  ~CsvFile() override;

  /// Length and checksum of what was written. Writing puts it on the disk; reading cuts the file to that length.
  /// \throws InputError if the file is shorter or begins with something else; if it is none that can be cut
  void remember(Archive& archive);

 private:
  class Buffer final : public std::streambuf {
   public:
    Buffer(std::string path, Opening opening);
    ~Buffer() override;
    void remember(Archive& archive);
    /// Hands on the complete lines.
    void write_lines();

   protected:
    int_type overflow(int_type c) override;
    std::streamsize xsputn(const char* text, std::streamsize count) override;
    int sync() override;

   private:
    [[noreturn]] void fail(const std::string& what) const;
    void cut_to(long length);

    std::string path_;
    int file_;
    std::string pending_;
    long length_ = 0;  ///< in the file, all complete lines
    Checksum checksum_;
  };
  Buffer buffer_;
};

}  // namespace hbvm::core

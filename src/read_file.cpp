#include "read_file.hpp"

#include <fstream>

#include "hbvm/error.hpp"

namespace hbvm::core {

std::string read_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text;
  char buffer[65536];
  while (file.read(buffer, sizeof buffer) || file.gcount() > 0)
    text.append(buffer, static_cast<std::size_t>(file.gcount()));
  // A file that was not opened has no end, nor has a folder.
  if (!file.eof()) throw InputError("cannot read '" + path.string() + "'");
  return text;
}

}  // namespace hbvm::core

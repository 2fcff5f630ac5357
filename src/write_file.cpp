#include "write_file.hpp"

#include <fstream>

#include "hbvm/error.hpp"

namespace hbvm::core {

void write_file(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw InputError("cannot write '" + path.string() + "'");
}

}  // namespace hbvm::core

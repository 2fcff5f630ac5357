#include "write_text.hpp"

#include <fstream>

#include "hbvm/error.hpp"

namespace hbvm {

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw InputError("--out: cannot write '" + path.string() + "'");
}

}  // namespace hbvm

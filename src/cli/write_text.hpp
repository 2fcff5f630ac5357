#pragma once

#include <filesystem>
#include <string>

namespace hbvm {

/// \throws InputError that names --out
void write_text(const std::filesystem::path& path, const std::string& text);

}  // namespace hbvm

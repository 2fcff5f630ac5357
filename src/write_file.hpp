#pragma once

#include <filesystem>
#include <string>

namespace hbvm::core {

/// Makes or replaces a file. \throws InputError with its name if it cannot be written
void write_file(const std::filesystem::path& path, const std::string& text);

}  // namespace hbvm::core

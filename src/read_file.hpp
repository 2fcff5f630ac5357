#pragma once

#include <filesystem>
#include <string>

namespace hbvm::core {

/// All bytes of a file. \throws InputError with its name if it cannot be read
std::string read_file(const std::filesystem::path& path);

}  // namespace hbvm::core

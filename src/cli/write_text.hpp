#pragma once

#include <filesystem>
#include <string>

namespace hbvm {

/// \throws InputError that names --out
void write_text(const std::filesystem::path& path, const std::string& text);

/// \throws InputError unless 1 <= jobs <= 1024
void check_jobs(int jobs);

}  // namespace hbvm

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hbvm::core {

/// A line "written to FILE" on standard error.
void say_written(const std::string& file);
/// One line for the files of a folder: "written to FOLDER: table.csv, table.md".
void say_written_together(const std::vector<std::string>& files);

/// Makes or replaces a file and says so. \throws InputError if it cannot be written
void write_and_say(const std::filesystem::path& file, const std::string& text);

/// Refuses "-" as the name of a file, which others take for standard output. \throws InputError
void refuse_dash(const std::string& option, const std::string& file);

/// Whether something may be put beside a file: not if it is a pipe or a device.
bool has_neighbours(const std::string& file);

}  // namespace hbvm::core

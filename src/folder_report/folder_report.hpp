#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace hbvm::core {

/// What a page of a report may have.
inline constexpr std::size_t report_bytes = 3'000'000;

/// One HTML page of the tables, drawings and texts that a folder and those in it hold. Tables are CSV, with what
/// describes them, or JSON; drawings are SVG and texts Markdown. It needs no other file and no network. Whatever stands
/// in the files is text or drawing and nothing else. Pointing at a drawing that hbvm made reads its values. Of tables
/// that would be too long some rows are shown. If that is not enough the largest drawings are left out. The page says
/// so.
/// \throws InputError if there is no such folder or nothing to report in it. It names file and line of a file that is
/// not what its name says
std::string folder_report(const std::filesystem::path& folder, const std::string& version, const std::string& command);

}  // namespace hbvm::core

#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace hbvm::core {

/// What a page of a report may have.
inline constexpr std::size_t report_bytes = 3'000'000;

/// One HTML page of all that a folder and those in it hold of tables (CSV, with what describes them; JSON), drawings
/// (SVG) and text in Markdown: it needs no other file and no network, and whatever stands in the files is text or
/// drawing and nothing else. Pointing at a drawing that hbvm made reads its values. Of tables that would be too long
/// some rows are shown, and if that is not enough the largest drawings are left out; the page says so.
/// \throws InputError if there is no such folder or nothing to report in it, and with file and line for a file that is
/// not what its name says
std::string folder_report(const std::filesystem::path& folder, const std::string& version, const std::string& command);

}  // namespace hbvm::core

#pragma once

#include <string>

#include "run/recording.hpp"
#include "run/run_request.hpp"

namespace hbvm::core {

/// A page is smaller than this, however long the run and large its scene.
constexpr std::size_t run_page_bytes = 1'000'000;

/// Whether a picture in this file is a page: by its ending, .html.
bool is_page(const std::string& file);

/// The run as a page of HTML that needs nothing besides itself: its scene moves, beside the curves of run_figure(). Its
/// numbers are the doubles of the recording, in decimals that read back exactly. Where all samples would be too many
/// for run_page_bytes, it has every k-th and the last. Their errors are then the greatest since the sample before.
/// \param command what makes the run again
/// \throws Error if not even its first and last state have room
/// \throws InputError if the library was built without dygraphs
std::string run_page(const RunRequest& request, const Recording& recording, const std::string& command);

}  // namespace hbvm::core

#pragma once

#include <string>

#include "run/moving_page.hpp"
#include "run/recording.hpp"
#include "run/run_request.hpp"

namespace hbvm::core {

/// Whether a picture in this file is a page: by its ending, .html.
bool is_page(const std::string& file);

/// The step that the last sample is after: that of the end, unless the run failed on the way.
long last_step(const Recording& recording);

/// What a page says of a run above and below; what moves is left to whoever asks.
MovingPage page_about(const RunRequest& request, const std::string& command);

/// The run as a page: its scene moves, beside the curves of run_figure().
/// \param command what makes the run again
/// \throws Error, InputError as moving_page() does
std::string run_page(const RunRequest& request, const Recording& recording, const std::string& command);

}  // namespace hbvm::core

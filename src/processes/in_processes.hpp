#pragma once

#include <functional>
#include <string>
#include <vector>

#include "long_work/cells.hpp"

namespace hbvm::core {

/// Runs cells in so many processes at a time, each of which is ended after its seconds of processor time. One that
/// crashes takes no other with it. To be called while the program has a single thread.
/// \param seconds of a cell, by its place; \param result made of how it ended
CellRunner in_processes(const std::vector<WorkCell>& cells, int jobs, std::function<double(std::size_t)> seconds,
                        std::function<std::string(std::size_t, const ProcessEnd&)> result);

}  // namespace hbvm::core

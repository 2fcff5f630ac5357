#pragma once

#include <functional>
#include <vector>

#include "hbvm/study.hpp"
#include "run/recording.hpp"
#include "run/run_request.hpp"
#include "step/registry.hpp"

namespace hbvm::core {

/// A method's run, and what a picture shows of it.
struct RecordedMethod {
  MethodRun figures;
  Recording recording;
  std::vector<std::string> q = {};  ///< at the end, if it came there
};

/// The run that is asked for, by each method in its place.
/// \param progress is called with steps of all runs
/// \throws InputError, Interrupted
std::vector<RecordedMethod> run_methods(const RunRequest& request, const std::vector<NamedMethod>& methods,
                                        const std::function<void(long, long)>& progress);

/// Tells each run that came to the end how many digits of its positions are right. That is -log10 of the greatest error
/// over the greatest coordinate, at most the digits of the precision. The end is found once, by the motion's Taylor
/// series in more digits. \return why there are none, or nothing
std::string count_digits(const RunRequest& request, std::vector<RecordedMethod>& runs);

}  // namespace hbvm::core

#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hbvm::core {

/// The candidate that `word` becomes by the fewest edits: a character put in, taken out or replaced. Empty if more than
/// half of its characters differ.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

/// The end of a message about an unknown word: ": did you mean 'length'?", or nothing if no candidate is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

/// The same where there are few enough to list: ": did you mean 'rod'? There are rod, plane", or "; there are rod,
/// plane".
std::string did_you_mean_or_list(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace hbvm::core

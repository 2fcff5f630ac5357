#pragma once

#include "compare/compare_methods.hpp"

namespace hbvm::core {

/// Motions over one another in equal axes, and one curve a method of each error: of H, of g and of the hidden
/// constraints. That of H stands on a logarithmic and on a linear axis. A motion that goes three times as far as the
/// calmest of them is drawn until then.
Figure methods_figure(const RunRequest& request, const std::vector<RecordedMethod>& runs, const std::string& command);

/// The same as a page, on which all move on one clock.
/// \throws Error, InputError as moving_page() does
std::string methods_page(const RunRequest& request, const std::vector<RecordedMethod>& runs,
                         const std::string& command);

}  // namespace hbvm::core

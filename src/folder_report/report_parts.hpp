#pragma once

#include <string_view>

namespace hbvm::core {

/// What a report's page is made of besides its contents, compiled in: the files of src/folder_report/page.
extern const std::string_view report_style, report_script;

}  // namespace hbvm::core

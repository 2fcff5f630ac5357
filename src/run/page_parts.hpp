#pragma once

#include <string>

namespace hbvm::core {

/// What a page of a run is made of, compiled in. It is the files of src/run/page, scripts one after another, and the
/// plotting library, empty if there was none.
struct PageParts {
  std::string html, style, script, dygraphs_style, dygraphs;
};
const PageParts& page_parts();

}  // namespace hbvm::core

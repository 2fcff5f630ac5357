#pragma once

#include <string>

namespace hbvm::core {

/// A drawing as a picture of an HTML page. Browsers run no script of a picture, follow no link in it, and load nothing
/// for it.
struct SvgPicture {
  std::string address;  ///< which holds the drawing itself: "data:image/svg+xml,..."
  std::string data;     ///< the JSON of figure_data, or nothing
};

/// \param file its name, for messages \throws InputError with file and line if it is no drawing
SvgPicture svg_picture(const std::string& text, const std::string& file);

}  // namespace hbvm::core

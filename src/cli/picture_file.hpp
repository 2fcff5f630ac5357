#pragma once

#include <functional>
#include <string>

#include "hbvm/figure.hpp"

namespace hbvm::core {

/// The file of a --plot: a picture by its ending .svg, .pdf or .png, or a page that moves, .html.
class PictureFile {
 public:
  /// \throws InputError for an ending that is none of these, or where nothing can be written
  explicit PictureFile(std::string file);

  /// Draws the figure or writes the page, whichever the ending asks for, and says so.
  /// \param page nothing if there is none \throws InputError if it is asked for nevertheless
  void write(const std::function<Figure()>& figure, const std::function<std::string()>& page) const;

 private:
  std::string file_;
};

}  // namespace hbvm::core

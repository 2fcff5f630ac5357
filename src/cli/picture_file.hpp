#pragma once

#include <functional>
#include <string>
#include <vector>

#include "hbvm/figure.hpp"

namespace hbvm::core {

/// The file of a --plot: a picture by its ending .svg, .pdf or .png, or one that moves, .html or .gif.
class PictureFile {
 public:
  /// \throws InputError for an ending that is none of these, or where nothing can be written
  explicit PictureFile(std::string file);

  /// Draws the figure or the frames, or writes the page, whichever the ending asks for, and says so.
  /// \param page, frames nothing if there are none \throws InputError if they are asked for nevertheless
  void write(const std::function<Figure()>& figure, const std::function<std::string()>& page,
             const std::function<std::vector<Figure>()>& frames = {}) const;

 private:
  std::string file_;
};

}  // namespace hbvm::core

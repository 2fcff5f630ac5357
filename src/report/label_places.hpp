#pragma once

#include <optional>
#include <vector>

#include "hbvm/figure.hpp"

namespace hbvm::core {

/// In pixels, to the right and up.
struct Rectangle {
  double left, bottom, width, height;

  bool overlaps(const Rectangle& other) const;
  bool is_within(const Rectangle& other) const;
};

/// A mark, and the size of what is to be written beside it; without a width there is nothing.
struct LabelledMark {
  PlotPoint at;
  double width, height;
};

/// Where each label stands: at the first side of its mark where it is within the box, and on no label or mark. Earlier
/// marks choose first. A label without such a place is left out.
std::vector<std::optional<Rectangle>> label_places(const std::vector<LabelledMark>& marks, const Rectangle& box);

}  // namespace hbvm::core

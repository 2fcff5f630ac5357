#include "label_places.hpp"

#include <algorithm>

namespace hbvm::core {
namespace {

/// How far a label is from its mark, and how much room a mark takes on each side.
constexpr double beside_mark = 9, half_a_mark = 5;

/// To the right, left, above and below, then at the corners.
std::vector<Rectangle> sides_of(const LabelledMark& mark) {
  std::vector<Rectangle> sides;
  for (const auto& [x, y] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}}) {
    const auto along = [](double at, int side, double size) {
      return side > 0 ? at + beside_mark : side < 0 ? at - beside_mark - size : at - size / 2;
    };
    sides.push_back({along(mark.at[0], x, mark.width), along(mark.at[1], y, mark.height), mark.width, mark.height});
  }
  return sides;
}

}  // namespace

bool Rectangle::overlaps(const Rectangle& other) const {
  return left < other.left + other.width && other.left < left + width && bottom < other.bottom + other.height &&
         other.bottom < bottom + height;
}

bool Rectangle::is_within(const Rectangle& other) const {
  return left >= other.left && left + width <= other.left + other.width && bottom >= other.bottom &&
         bottom + height <= other.bottom + other.height;
}

std::vector<std::optional<Rectangle>> label_places(const std::vector<LabelledMark>& marks, const Rectangle& box) {
  std::vector<Rectangle> taken;
  for (const LabelledMark& mark : marks)
    taken.push_back({mark.at[0] - half_a_mark, mark.at[1] - half_a_mark, 2 * half_a_mark, 2 * half_a_mark});
  std::vector<std::optional<Rectangle>> places(marks.size());
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (marks[i].width == 0) continue;
    for (const Rectangle& side : sides_of(marks[i])) {
      if (!side.is_within(box)) continue;
      if (std::any_of(taken.begin(), taken.end(), [&](const Rectangle& other) { return side.overlaps(other); }))
        continue;
      places[i] = side;
      taken.push_back(side);
      break;
    }
  }
  return places;
}

}  // namespace hbvm::core

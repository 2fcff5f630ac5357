#pragma once

#include <vector>

#include "series_step.hpp"
#include "step_course.hpp"

namespace hbvm::core {

/// What a proof says of one step. If the exact motion is within `before` of the series at the start, it stays in the
/// tube. At the end it is within `after` of them. The pieces are those on which that is shown.
struct ProvedStep {
  SeriesStep series;
  ErrorDistance before, tube, after;
  std::vector<PieceEnd> pieces;
};

}  // namespace hbvm::core

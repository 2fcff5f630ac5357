#pragma once

#include <vector>

#include "scalar/uncertain.hpp"

namespace hbvm::core {

using UncertainRow = std::vector<Uncertain>;

/// The x with a x = 0, as rows that span them: in reduced echelon form, each led by the coefficient 1. What may be 0,
/// by the error bounds of a, counts as 0.
///
/// The columns before `first_of_second` and those from it on may have different units, and every row its own. No two
/// entries of different units are ever compared, so that a row of small numbers counts as much as one of large ones.
std::vector<UncertainRow> null_space(std::vector<UncertainRow> a, std::size_t columns, std::size_t first_of_second);

}  // namespace hbvm::core

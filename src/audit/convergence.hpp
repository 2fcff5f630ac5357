#pragma once

#include <optional>
#include <vector>

namespace hbvm::core {

/// An error at one step, as binary logarithms: no precision is too high for them.
struct Rung {
  double step;                ///< log2 h
  double error;               ///< log2 of the error; its greatest over several starts
  double floor;               ///< log2 of what round-off and the error of the reference explain
  bool by_reference = false;  ///< it is the error of the reference that counts: a better one could show more
  bool is_clean() const { return error > floor; }
};

/// The limit of the slopes d log(error) / d log(h) and what it can be trusted to: it lies within value +- uncertainty.
struct Rate {
  double value = 0, uncertainty = 0;
  double halvings = 0;  ///< of the step, between the first and the last rung used
};

/// The rate that the slopes between five clean rungs in a row tend to. Its uncertainty covers what the higher terms may
/// still change, from how the slopes change, and what the floors may hide. Of all such five, the least uncertain count,
/// as long as every finer clean rung lies where they foretell it. Where none does, the finest five count: there another
/// term takes over. If the changes grow from slope to slope, the uncertainty is infinite. \param rungs from coarse to
/// fine \return nothing if there are no five clean rungs in a row with at least four halvings between them
std::optional<Rate> convergence_rate(const std::vector<Rung>& rungs);

}  // namespace hbvm::core

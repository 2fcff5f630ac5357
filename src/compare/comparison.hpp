#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "hbvm/figure.hpp"
#include "hbvm/results.hpp"
#include "scene/scene.hpp"

namespace hbvm::core {

/// The step that a file of results says it was made with. It is "hbvm:step" of what describes it (JSON, as hbvm run
/// writes it beside its CSV), or else a comment "# step = 1/64" of its own. Empty if there is none.
std::string step_stored(const std::string& csv, const std::string& metadata);

struct ComparisonRequest {
  Scene scene;
  std::vector<ResultsFile> files;
  /// What theirs is, an expression in the names of their columns, and which of ours that is. Ours are "t", "bob.x",
  /// "bob.px", "bob.vx" and what the scene observes. Angles may differ by full turns. Columns of these names need not
  /// be mapped, nor "time", "q_3", "p_3" and "v_3". Of "bob.px" and "output.bob.px" of a trajectory of hbvm run the
  /// second, which is tangential, is taken.
  std::vector<std::pair<std::string, std::string>> map;
  std::function<void(double)> progress = {};
};

/// Right digits of results beside the reference, which is found in the store or computed at their times. At most
/// `most_times` of a file are compared, evenly spaced, its last among them. \throws InputError for files, columns and
/// maps that cannot be read, naming line and column; IntegrationError
Comparison compare_with_reference(const ComparisonRequest& request);
inline constexpr std::size_t most_times = 50;

/// Digits against time: a panel a file, a curve a component, and what the growth of errors alone would leave.
/// \param scene its name
Figure comparison_figure(const Comparison& against, const std::string& scene);

}  // namespace hbvm::core

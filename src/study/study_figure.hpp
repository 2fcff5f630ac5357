#pragma once

#include "experiment.hpp"

namespace hbvm::core {

/// A [[figure]] of study.toml: its runs, whose results are trajectories as the text of CSV files, and the picture. What
/// comes out are the files written. These are the trajectories (CSV, and what describes them) and the picture (SVG). It
/// is a warning where it cannot be drawn.
Part<Drawn> study_figure(const Experiment& experiment, TomlTable reader);

}  // namespace hbvm::core

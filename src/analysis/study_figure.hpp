#pragma once

#include "experiment.hpp"

namespace hbvm {

/// Makes the runs of a [[figure]] of study.toml and draws it.
/// \return the files written to `results`: the trajectories (CSV) and the picture (SVG)
std::vector<std::string> study_figure(const Experiment& experiment, TomlTable reader,
                                      const std::vector<std::string>& provenance, const std::filesystem::path& results);

}  // namespace hbvm

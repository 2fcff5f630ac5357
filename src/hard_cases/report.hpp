#pragma once

#include <string>
#include <vector>

#include "hard_cases/case.hpp"
#include "hbvm/figure.hpp"
#include "hbvm/table.hpp"

namespace hbvm::core {

/// One row a case, a group for each family.
Table stability_table(const std::vector<CaseFinding>& findings);

/// {"cases": [{"case", "parameter", "precision", "expected", "verdict", "figure", "bound", "unit", "family", "failure",
/// "message", "warnings", "reason", "criteria", "cpu_seconds"}, …]}, after version, command and summary. Figure and
/// bound are those of the criterion that decides, null if there is none; the time is null if it was known from before.
std::string to_json(const std::vector<CaseFinding>& findings, const std::string& command);

/// "200 cases: 180 hold, 15 fail as expected, 4 warn as expected, 1 is not as expected".
std::string summary(const std::vector<CaseFinding>& findings);

/// The figures of studies/stability, with their data in files of this folder. They show the growth of round-off, digits
/// near the separatrix, a light body beside a heavy one, the hidden constraint by parity of s. `before` is a folder
/// with separatrix_before.csv and light_body_before.csv, what an earlier program gave; without them there is no such
/// curve.
/// \throws InputError if the folder cannot be written to, StepError
std::vector<Figure> stability_figures(const std::string& folder, const std::string& before);

/// A finding without the time it took: JSON that reads back to the last bit.
std::string to_result(const CaseFinding& finding);
/// \throws InputError if it is none
CaseFinding read_case_result(const std::string& text);

}  // namespace hbvm::core

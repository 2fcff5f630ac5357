#pragma once

#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include "hbvm/analysis/stability/case.hpp"
#include "hbvm/report/figure.hpp"
#include "hbvm/report/table.hpp"

namespace hbvm {

/// One row a case, a group for each family.
Table stability_table(const std::vector<CaseFinding>& findings);

/// {"cases": [{"case", "parameter", "precision", "expected", "verdict", "figure", "bound", "unit", "family", "failure",
/// "warnings", "reason", "cpu_seconds", "criteria"}, …]}, after version, command and summary. Figure and bound are
/// those of the criterion that decides, null if there is none.
std::string to_json(const std::vector<CaseFinding>& findings, const std::string& command);

/// "200 cases: 180 hold, 15 fail as expected, 4 warn as expected, 1 is not as expected".
std::string summary(const std::vector<CaseFinding>& findings);

/// The figures of studies/stability, with their data in files of this folder: growth of round-off, digits near the
/// separatrix, a light body beside a heavy one, the hidden constraint by parity of s. `before` is a folder with
/// separatrix_before.csv and light_body_before.csv, what an earlier program gave; without them there is no such curve.
/// \throws InputError if the folder cannot be written to, StepError
std::vector<Figure> stability_figures(const std::string& folder, const std::string& before);

/// A finding as one line of text under its case's key, and the findings of such lines, of this version of the program
/// alone: a line that was cut off is left out.
std::string to_line(const CaseFinding& finding, const std::string& key);
std::map<std::string, CaseFinding> read_case_lines(std::istream& lines);

}  // namespace hbvm

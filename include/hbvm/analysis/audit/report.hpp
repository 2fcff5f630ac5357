#pragma once

#include <map>
#include <string>
#include <vector>

#include "hbvm/analysis/audit/claim.hpp"
#include "hbvm/report/figure.hpp"
#include "hbvm/report/table.hpp"

namespace hbvm {

/// One row a finding, a group for each problem.
Table audit_table(const std::vector<Finding>& findings);

/// {"claims": [{"claim", "quantity", "problem", "method", "k", "s", "over", "form", "predicted", "measured",
/// "uncertainty", "precision", "coefficients_to", "interval", "seconds", "verdict", "reason", "reference", "evidence"},
/// …]}, after version, command and counts. k and s are null for a tableau, measured and uncertainty if there was
/// nothing but round-off, the interval of claims about coefficients.
std::string to_json(const std::vector<Finding>& findings, const std::string& command);

/// "523 claims: 523 hold, 0 fail, 0 undecidable, 0 of degenerate motions, 0 not run".
std::string summary(const std::vector<Finding>& findings);

/// A finding as one line of text under its key, and the findings of such lines, of this version of the program alone: a
/// line that was cut off is left out.
std::string to_line(const Finding& finding, const std::string& key);
std::map<std::string, Finding> read_lines(const std::string& path);

/// The figure that explains the audit, with its data in files of this folder: the same errors in double, quad and 50
/// digits, and the components of one run, with triangles that show the slopes.
/// \throws InputError if the folder cannot be written to
Figure audit_figure(const std::string& folder);

}  // namespace hbvm

#pragma once

#include <string>
#include <vector>

#include "audit/finding.hpp"
#include "hbvm/figure.hpp"
#include "hbvm/table.hpp"

namespace hbvm::core {

/// One row a finding, a group for each problem; with the reasons as a last column if asked for.
Table audit_table(const std::vector<Finding>& findings, bool with_reasons = false);

/// {"claims": [{"claim", "quantity", "problem", "method", "k", "s", "over", "form", "predicted", "measured",
/// "uncertainty", "precision", "coefficients_to", "interval", "seconds", "verdict", "reason", "reference", "evidence"},
/// …]}, after version, command and counts. k and s are null for a tableau, measured and uncertainty if there was
/// nothing but round-off, the interval of claims about coefficients.
std::string to_json(const std::vector<Finding>& findings, const std::string& command);

/// XML of JUnit, for services that run tests: a case for each claim.
std::string to_junit(const std::vector<Finding>& findings, const std::string& command);

/// "523 claims: 523 hold, 0 fail, 0 undecidable, 0 of degenerate motions, 0 not run".
std::string summary(const std::vector<Finding>& findings);

/// What was found, without the claims and the time it took. The JSON says the same whenever it is measured, and reads
/// back to the last bit.
std::string to_result(const std::vector<Finding>& findings);
/// \throws InputError if it is none
std::vector<Finding> read_result(const std::string& text);

/// The figure that explains the audit, with its data in files of this folder. It shows the same errors in double, quad
/// and 50 digits, and the components of one run. Triangles show the slopes.
/// \throws InputError if the folder cannot be written to
Figure audit_figure(const std::string& folder);

}  // namespace hbvm::core

#pragma once

#include <limits>
#include <string>
#include <vector>

namespace hbvm::core {

/// One check as services that run tests show it.
struct JunitCase {
  enum class Outcome { passed, failed, skipped };
  std::string group, name;
  Outcome outcome = Outcome::passed;
  std::string message = {};                                   ///< of one that did not pass
  double seconds = std::numeric_limits<double>::quiet_NaN();  ///< unless it is known
};

/// A file of JUnit's XML with one suite.
std::string junit_xml(const std::string& suite, const std::vector<JunitCase>& cases);

}  // namespace hbvm::core

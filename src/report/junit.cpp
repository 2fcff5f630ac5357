#include "report/junit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hbvm::core {
namespace {

/// As the value of an attribute. Characters that XML has no place for become "?".
std::string attribute(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\n':
        result += "&#10;";
        break;
      case '\t':
        result += "&#9;";
        break;
      default:
        result += static_cast<unsigned char>(c) < ' ' ? '?' : c;
    }
  }
  return result;
}

}  // namespace

std::string junit_xml(const std::string& suite, const std::vector<JunitCase>& cases) {
  const auto count = [&](JunitCase::Outcome outcome) {
    return std::count_if(cases.begin(), cases.end(), [&](const JunitCase& c) { return c.outcome == outcome; });
  };
  std::string xml = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"0\" skipped=\"{}\">\n",
      attribute(suite), cases.size(), count(JunitCase::Outcome::failed), count(JunitCase::Outcome::skipped));
  for (const JunitCase& c : cases) {
    xml += fmt::format("  <testcase classname=\"{}\" name=\"{}\"", attribute(c.group), attribute(c.name));
    if (std::isfinite(c.seconds)) xml += fmt::format(" time=\"{:.3f}\"", c.seconds);
    if (c.outcome == JunitCase::Outcome::passed)
      xml += "/>\n";
    else
      xml += fmt::format("><{} message=\"{}\"/></testcase>\n",
                         c.outcome == JunitCase::Outcome::failed ? "failure" : "skipped", attribute(c.message));
  }
  return xml + "</testsuite>\n";
}

}  // namespace hbvm::core

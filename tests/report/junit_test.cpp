#include "report/junit.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace hbvm::core {
namespace {

TEST(Junit, CountsAndEscapes) {
  const std::string xml =
      junit_xml("hbvm audit a<b.toml",
                {{"rk4", "order", JunitCase::Outcome::passed, {}, 0.25},
                 {"rk4", "reversal", JunitCase::Outcome::skipped, "", 0},
                 {"rk4", "embedded \"order\"", JunitCase::Outcome::failed, "3 & not 4\nsee", 0},
                 {"rk4", "drift", JunitCase::Outcome::skipped, "\x01", std::numeric_limits<double>::quiet_NaN()}});
  EXPECT_EQ(xml,
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<testsuite name=\"hbvm audit a&lt;b.toml\" tests=\"4\" failures=\"1\" errors=\"0\" skipped=\"2\">\n"
            "  <testcase classname=\"rk4\" name=\"order\" time=\"0.250\"/>\n"
            "  <testcase classname=\"rk4\" name=\"reversal\" time=\"0.000\"><skipped message=\"\"/></testcase>\n"
            "  <testcase classname=\"rk4\" name=\"embedded &quot;order&quot;\" time=\"0.000\"><failure message=\"3 "
            "&amp; not 4&#10;see\"/></testcase>\n"
            "  <testcase classname=\"rk4\" name=\"drift\"><skipped message=\"?\"/></testcase>\n"
            "</testsuite>\n");
}

}  // namespace
}  // namespace hbvm::core

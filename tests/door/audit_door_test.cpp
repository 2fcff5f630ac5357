#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "hbvm/audit.hpp"
#include "hbvm/error.hpp"

namespace hbvm {
namespace {

TEST(DoorAudit, FindsAWrongWeight) {
  const Tableau midpoint{.name = "midpoint", .A = {{"1/2"}}, .b = {1}, .c = {}, .order = 2};
  const Claims claims = tableau_claims(midpoint);
  ASSERT_GT(claims.size(), 3u);
  const Audit found = audit(claims);
  EXPECT_EQ(found.count("holds"), static_cast<long>(claims.size())) << found.summary;
  EXPECT_EQ(nlohmann::json::parse(to_json(found)).at("claims").size(), claims.size());
  Tableau wrong = midpoint;
  wrong.b = {"1001/1000"};
  EXPECT_GT(audit(tableau_claims(wrong)).count("fails"), 0);
}

TEST(DoorAudit, EndsWhenItIsAskedTo) {
  std::stop_source source;
  AuditOptions options;
  options.stop = source.get_token();
  options.progress = [&](long, long) { source.request_stop(); };  // once the first claims are decided
  EXPECT_THROW(audit(method_claims("rattle") + method_claims("hbvm:2,1"), options), Interrupted);
  // Before any is: also of coefficients, which make no steps.
  EXPECT_THROW(audit(tableau_claims({.name = "Euler's", .A = {{0}}, .b = {1}, .c = {}}), options), Interrupted);
}

TEST(DoorAudit, ClaimsAddUp) {
  const Claims both = method_claims("rattle") + method_claims("hbvm:2,1");
  EXPECT_EQ(both.size(), method_claims("rattle").size() + method_claims("hbvm:2,1").size());
  EXPECT_GT(paper_claims(true).size(), paper_claims(false).size());
  EXPECT_THROW(method_claims("none"), InputError);
  EXPECT_THROW(read_claims("/nowhere.toml"), InputError);
  EXPECT_TRUE(audit(Claims()).findings.empty());
}

}  // namespace
}  // namespace hbvm

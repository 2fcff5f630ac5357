#include <algorithm>

#include "audit/audit.hpp"
#include "audit/claims.hpp"
#include "audit/report.hpp"
#include "door/door.hpp"
#include "hbvm/audit.hpp"
#include "step/registry.hpp"

namespace hbvm {

struct Claims::Content {
  std::vector<core::Claim> claims;
};

namespace {

Claims claims_of(std::vector<core::Claim> claims) {
  return Claims(std::make_shared<const Claims::Content>(Claims::Content{std::move(claims)}));
}

}  // namespace

Claims::Claims() : content_(std::make_shared<const Content>()) {}

std::size_t Claims::size() const { return content_->claims.size(); }

Claims operator+(const Claims& a, const Claims& b) {
  std::vector<core::Claim> all = a.content().claims;
  all.insert(all.end(), b.content().claims.begin(), b.content().claims.end());
  return claims_of(std::move(all));
}

Claims paper_claims(bool full) {
  const core::Extent extent = full ? core::Extent::full : core::Extent::quick;
  return claims_of(core::paper_claims(extent)) + claims_of(core::general_claims(extent)) +
         claims_of(core::work_claims(extent)) + claims_of(core::between_claims(extent));
}

Claims tableau_claims(const Tableau& tableau) { return claims_of(core::tableau_claims(core::completed(tableau))); }

Claims method_claims(const std::string& method) {
  const core::Admitted admitted({});
  return claims_of(core::method_claims(core::parse_method(method)));
}

Claims read_claims(const std::string& path) {
  const core::Admitted admitted({});
  return claims_of(core::read_claims(path));
}

Audit audit(const Claims& claims, const AuditOptions& door) {
  const core::Admitted admitted(door.stop);
  core::AuditOptions options;
  options.jobs = door.jobs;
  options.limit = door.limit;
  options.coefficient_digits = door.coefficient_digits;
  options.progress = door.progress;
  if (door.until) options.until = core::expression_of(*door.until, "until");
  const std::vector<core::Finding> findings = core::audit(claims.content().claims, options);
  Audit result;
  for (const core::Finding& f : findings)
    result.findings.push_back({.claim = core::readable(f.claim.label),
                               .quantity = std::string(core::name_of(f.claim.quantity)),
                               .problem = f.claim.problem,
                               .method = f.claim.method_text(),
                               .verdict = std::string(core::name_of(f.verdict)),
                               .predicted = f.claim.predicted,
                               .measured = f.measured,
                               .uncertainty = f.uncertainty,
                               .precision = f.precision,
                               .reference = f.reference,
                               .reason = f.reason});
  result.summary = core::summary(findings);
  result.json = core::to_json(findings, "");
  return result;
}

long Audit::count(const std::string& verdict) const {
  return std::count_if(findings.begin(), findings.end(), [&](const Finding& f) { return f.verdict == verdict; });
}

std::string to_json(const Audit& audit) { return audit.json; }

}  // namespace hbvm

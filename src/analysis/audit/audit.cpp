#include "hbvm/analysis/audit/audit.hpp"

#include <atomic>
#include <exception>
#include <map>
#include <mutex>
#include <thread>

#include "auditor.hpp"

namespace hbvm {
namespace {

std::string subject_key(const Claim& claim) { return claim.problem + "|" + claim.method->key(); }

std::vector<Auditor::Unit> units_of(const std::vector<Claim>& claims, const std::vector<bool>& skip) {
  using Kind = Auditor::Kind;
  std::vector<Auditor::Unit> units;
  std::map<std::pair<Kind, std::string>, std::size_t> places;
  for (std::size_t i = 0; i < claims.size(); ++i) {
    if (skip[i]) continue;
    const Kind kind = Auditor::kind_of(claims[i]);
    std::string key = subject_key(claims[i]);
    if (kind == Kind::special) key += "|" + std::to_string(i);
    const auto [place, is_new] = places.try_emplace({kind, key}, units.size());
    if (is_new) units.push_back({kind, {}});
    units[place->second].members.push_back(i);
  }
  return units;
}

}  // namespace

std::string key_of(const Claim& claim) {
  return std::string(name_of(claim.quantity)) + "|" + subject_key(claim) + "|" +
         std::to_string(static_cast<int>(claim.span)) + std::to_string(static_cast<int>(claim.form)) + "|" +
         std::to_string(claim.predicted) + "|" + std::to_string(claim.tolerance) +
         (claim.of_degenerate_motion ? "|degenerate" : "");
}

std::vector<Finding> audit(const std::vector<Claim>& claims, const AuditOptions& options) {
  std::vector<Finding> findings(claims.size());
  std::vector<bool> skip(claims.size(), false);
  long decided = 0;
  for (std::size_t i = 0; i < claims.size(); ++i) {
    const Finding* const known = options.known ? options.known(key_of(claims[i])) : nullptr;
    if (known) {
      findings[i] = *known;
      skip[i] = true;
      ++decided;
    }
    findings[i].claim = claims[i];
  }
  const std::vector<Auditor::Unit> units = units_of(claims, skip);
  const long total = static_cast<long>(claims.size());
  if (options.progress) options.progress(decided, total);

  Motions motions;
  std::atomic<std::size_t> next{0};
  std::mutex reporting;
  std::exception_ptr error;
  const auto work = [&] {
    for (std::size_t u = next++; u < units.size(); u = next++) {
      try {
        Auditor(claims, units[u], options, motions, findings).work();
      } catch (...) {
        const std::lock_guard lock(reporting);
        if (!error) error = std::current_exception();
        next = units.size();
        break;
      }
      const std::lock_guard lock(reporting);
      for (const std::size_t i : units[u].members)
        if (options.found) options.found(findings[i]);
      decided += static_cast<long>(units[u].members.size());
      if (options.progress) options.progress(decided, total);
    }
    mpfr_free_cache();
  };
  {
    std::vector<std::jthread> threads;
    for (int i = 1; i < options.jobs; ++i) threads.emplace_back(work);
    work();
  }
  if (error) std::rethrow_exception(error);
  return findings;
}

}  // namespace hbvm

#include "audit/audit.hpp"

#include <map>

#include "audit/report.hpp"
#include "auditor.hpp"
#include "checksum.hpp"
#include "hbvm/error.hpp"

namespace hbvm::core {
namespace {

std::string subject_key(const Claim& claim) { return claim.problem + "|" + claim.method->key(); }

std::vector<Auditor::Unit> units_of(const std::vector<Claim>& claims) {
  using Kind = Auditor::Kind;
  std::vector<Auditor::Unit> units;
  std::map<std::pair<Kind, std::string>, std::size_t> places;
  for (std::size_t i = 0; i < claims.size(); ++i) {
    const Kind kind = Auditor::kind_of(claims[i]);
    std::string key = subject_key(claims[i]);
    if (kind == Kind::special) key += "|" + std::to_string(i);
    const auto [place, is_new] = places.try_emplace({kind, key}, units.size());
    if (is_new) units.push_back({kind, {}});
    units[place->second].members.push_back(i);
  }
  return units;
}

/// Of the scenes themselves, not of their names: files may change.
class SceneSums {
 public:
  const std::string& of(const std::string& problem) {
    const auto [place, is_new] = known_.try_emplace(problem);
    if (!is_new || problem == "tableau") return place->second;
    try {
      place->second = Checksum(write_scene(load_scene(problem))).text();
    } catch (const Error&) {
      place->second = "none";
    }
    return place->second;
  }

 private:
  std::map<std::string, std::string> known_;
};

/// All that a unit's findings depend on.
std::string key_of(const std::vector<Claim>& claims, const Auditor::Unit& unit, const AuditOptions& options,
                   SceneSums& scenes) {
  const Claim& subject = claims[unit.members.front()];
  std::string key = subject_key(subject) + "|" + scenes.of(subject.problem);
  for (const long number :
       {static_cast<long>(unit.kind), static_cast<long>(options.starts), static_cast<long>(options.first_start),
        static_cast<long>(options.log2_interval), options.most_steps, static_cast<long>(options.coefficient_digits)})
    key += "|" + std::to_string(number);
  key += "|" + std::to_string(options.limit) + "|" + (options.until ? options.until->text() : "");
  Checksum members;
  for (const std::size_t i : unit.members) members.add(key_of(claims[i]) + "\n");
  return key + "|" + members.text();
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
  for (std::size_t i = 0; i < claims.size(); ++i) findings[i].claim = claims[i];
  const std::vector<Auditor::Unit> units = units_of(claims);
  Motions motions;
  SceneSums scenes;
  std::vector<WorkCell> cells;
  for (const Auditor::Unit& unit : units) {
    cells.push_back({key_of(claims, unit, options, scenes), [&] {
                       Auditor(claims, unit, options, motions, findings).work();
                       std::vector<Finding> own;
                       for (const std::size_t i : unit.members) own.push_back(findings[i]);
                       return to_result(own);
                     }});
  }
  const auto results = run_cells(cells, options);

  std::vector<bool> decided(claims.size(), false);
  for (std::size_t u = 0; u < units.size(); ++u) {
    if (!results[u] || !options.shard.has(u)) continue;
    const std::vector<Finding> own = read_result(*results[u]);
    for (std::size_t n = 0; n < own.size(); ++n) {
      Finding& finding = findings[units[u].members.at(n)];
      Finding read = own[n];
      read.claim = finding.claim;
      read.seconds = finding.seconds;
      finding = std::move(read);
      decided[units[u].members[n]] = true;
    }
  }
  std::vector<Finding> all;
  for (std::size_t i = 0; i < claims.size(); ++i)
    if (decided[i]) all.push_back(std::move(findings[i]));
  return all;
}

}  // namespace hbvm::core

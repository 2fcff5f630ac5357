#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "hbvm/method.hpp"

namespace hbvm {

/// Statements about methods, each of which an audit decides.
class Claims {
 public:
  struct Content;
  Claims();
  explicit Claims(std::shared_ptr<const Content> content) : content_(std::move(content)) {}

  std::size_t size() const;
  const Content& content() const { return *content_; }
  /// These and then those.
  friend Claims operator+(const Claims& a, const Claims& b);

 private:
  std::shared_ptr<const Content> content_;
};

/// The paper's statements: all, or those of s = 1, 2, 3 on the smaller problems.
Claims paper_claims(bool full);
/// What a Runge-Kutta method must show: its order, that of its energy error, and symmetry and conserved angular
/// momentum if its coefficients say so.
Claims tableau_claims(const Tableau& tableau);
/// What a method of the program says of itself. \throws InputError
Claims method_claims(const std::string& method);
/// Those of a TOML file. \throws InputError with file and line
Claims read_claims(const std::string& path);

struct AuditOptions {
  int jobs = 1;                      ///< threads
  double limit = 120;                ///< seconds of processor time a claim may take; 0: any
  std::optional<Number> until = {};  ///< all of the motion up to this time is looked at
  int coefficient_digits = 1000;     ///< in which coefficients are held against their conditions; 0: not at all
  std::function<void(long done, long of)> progress = {};  ///< called now and then, from any thread
  std::stop_token stop = {};
};

/// What was found out about a claim.
struct Finding {
  std::string claim, quantity, problem, method;
  std::string verdict;                                  ///< "holds", "fails", "undecidable", "degenerate" or "not run"
  double predicted = 0, measured = 0, uncertainty = 0;  ///< a rate or value; NaN if there is nothing but round-off
  std::string precision;                                ///< the greatest in which errors entered the verdict
  std::string reference;                                ///< what errors are measured against
  std::string reason;                                   ///< of the verdict
};

struct Audit {
  std::vector<Finding> findings;
  std::string summary;  ///< "8 claims: 8 hold, 0 fail, ..."
  std::string json;     ///< what to_json() gives

  /// Of this verdict.
  long count(const std::string& verdict) const;
};

/// Decides each claim: precision is raised from double to mpfr:400 as long as one is undecided.
Audit audit(const Claims& claims, const AuditOptions& options = {});

/// One JSON object, as `hbvm audit --json` prints it.
std::string to_json(const Audit& audit);

}  // namespace hbvm

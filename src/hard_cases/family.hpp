#pragma once

#include "hard_cases/collection.hpp"
#include "measure.hpp"

namespace hbvm::core {

/// One run of a hard case, but for its precision.
struct HardRun {
  std::string method, solver = "auto", step, until;
};

/// Collects the cases of one family.
class Family {
 public:
  Family(std::vector<HardCase>& cases, std::string name, Collection collection)
      : cases_(cases), name_(std::move(name)), full_(collection == Collection::full) {}

  bool full() const { return full_; }
  /// The precisions of each case: all in the full collection, the first alone in the quick one.
  std::vector<std::string> precisions(std::vector<std::string> all = {"double", "quad", "mpfr:50"}) const {
    if (!full_) all.resize(1);
    return all;
  }

  using Measure = std::function<CaseResult(const std::string& precision)>;
  void add(const std::string& name, const std::string& parameter, const std::vector<std::string>& precisions,
           const Expected& expected, const Measure& measure, double seconds = 0) const {
    for (std::string precision : precisions) {
      if (precision == "quad") precision = precision_of_34_digits();
      cases_.push_back({name_, name, parameter, precision, expected,
                        seconds > 0 ? seconds
                        : full_     ? 300
                                    : 20,
                        [measure, precision] { return measure(precision); }});
    }
  }
  /// A run of a scene, measured by what `measure` does with the request.
  void add_run(const std::string& name, const std::string& parameter, const std::vector<std::string>& precisions,
               const Expected& expected, const std::function<Scene()>& scene, const HardRun& run,
               CaseResult (*measure)(const RunRequest&) = accuracy, double seconds = 0) const {
    add(
        name, (parameter.empty() ? "" : parameter + ", ") + run.method + ", h = " + run.step + ", " + run.solver,
        precisions, expected,
        [=](const std::string& precision) {
          return guarded(
              [&] { return measure(request_of(scene(), run.method, run.solver, run.step, run.until, precision)); });
        },
        seconds);
  }

 private:
  std::vector<HardCase>& cases_;
  std::string name_;
  bool full_;
};

/// The ends of a run that are right wherever numbers decide whether the step can be made.
inline Expected holds() { return {}; }
inline Expected holds_or(std::vector<std::string> failures) { return {true, std::move(failures), {}, {}}; }

/// The families, in the order of the table.
void add_coefficients(std::vector<HardCase>& cases, Collection collection);
void add_constraints(std::vector<HardCase>& cases, Collection collection);
void add_masses(std::vector<HardCase>& cases, Collection collection);
void add_scaling(std::vector<HardCase>& cases, Collection collection);
void add_uncoupled(std::vector<HardCase>& cases, Collection collection);
void add_units(std::vector<HardCase>& cases, Collection collection);
void add_encounters(std::vector<HardCase>& cases, Collection collection);
void add_separatrix(std::vector<HardCase>& cases, Collection collection);
void add_steps(std::vector<HardCase>& cases, Collection collection);
void add_stiffness(std::vector<HardCase>& cases, Collection collection);
void add_long_runs(std::vector<HardCase>& cases, Collection collection);
void add_hidden(std::vector<HardCase>& cases, Collection collection);
void add_chain(std::vector<HardCase>& cases, Collection collection);
void add_digits(std::vector<HardCase>& cases, Collection collection);
void add_reversal(std::vector<HardCase>& cases, Collection collection);
void add_beads(std::vector<HardCase>& cases, Collection collection);
void add_momenta(std::vector<HardCase>& cases, Collection collection);

}  // namespace hbvm::core

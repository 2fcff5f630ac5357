#pragma once

#include "hard_cases/collection.hpp"
#include "measure.hpp"

namespace hbvm::core {

/// One run of a hard case, but for its precision.
struct HardRun {
  std::string method, solver = "auto", step, until;
};

inline const std::vector<std::string> all_precisions{"double", "quad", "mpfr:50"};

/// Collects the cases of one family.
class Family {
 public:
  Family(std::vector<HardCase>& cases, std::string name, Collection collection)
      : cases_(cases), name_(std::move(name)), full_(collection == Collection::full) {}

  bool full() const { return full_; }
  /// The precisions of each case: all in the full collection, the first alone in the quick one.
  std::vector<std::string> precisions() const { return full_ ? all_precisions : std::vector{all_precisions.front()}; }

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

/// The families.
void add_coefficients(const Family& family);
void add_constraints(const Family& family);
void add_masses(const Family& family);
void add_scaling(const Family& family);
void add_uncoupled(const Family& family);
void add_units(const Family& family);
void add_encounters(const Family& family);
void add_separatrix(const Family& family);
void add_steps(const Family& family);
void add_stiffness(const Family& family);
void add_long_runs(const Family& family);
void add_hidden(const Family& family);
void add_chain(const Family& family);
void add_digits(const Family& family);
void add_reversal(const Family& family);
void add_beads(const Family& family);
void add_momenta(const Family& family);

}  // namespace hbvm::core

#include "hard_cases/family.hpp"
#include "hard_cases/scenes.hpp"

namespace hbvm::core {
namespace {

/// Accuracy, and what the run says against itself.
CaseResult accuracy_and_warnings(const RunRequest& request) {
  CaseResult result = accuracy(request);
  result.warnings = warnings_of(run(request, {}));
  return result;
}

}  // namespace

void add_constraints(const Family& family) {
  const std::string singular = "near_singular_constraints";
  for (const std::string d : {"1e-2", "1e-4", "1e-6"})
    for (const std::string solver : {"auto", "newton", "fixed-point"}) {
      if (!family.full() && (d != "1e-6" || solver == "fixed-point")) continue;
      auto precisions = all_precisions;
      if (family.full() && d == "1e-6") precisions.emplace_back("mpfr:200");
      family.add_run("flat triangle", "height " + d, precisions, holds(), [d] { return flat_triangle(d); },
                     {"hbvm:8,8", solver, "1/16", "1"});
    }
  for (const std::string r : {"1e-2", "1e-4", "1e-6"}) {
    if (!family.full() && r == "1e-2") continue;
    // In double a condition of 1e12 leaves four digits.
    family.add_run("two rods nearly collinear", "height " + r, all_precisions,
                   r == "1e-6" ? holds_or({singular}) : holds(), [r] { return stretched_rods(r); },
                   {"hbvm:4,4", "auto", "1/16", "1"});
  }
  Expected warned = holds();
  warned.warning = singular;
  // Before the fold at t = 0.8, and after it: any step agrees on the wrong branch.
  for (const std::string step : {"1/16", "1/64", "1/256"})
    family.add_run(
        "four-bar linkage through its fold", "difference 1e-10", all_precisions, warned,
        [] { return folding_linkage("1e-10"); }, {"hbvm:4,4", "auto", step, "2"}, energy);
  Expected redundant = holds();
  redundant.warning = "redundant_constraints";
  // In double they are redundant, in quad they leave four digits.
  for (const std::string& precision : all_precisions) {
    Expected in_line = precision == "double" ? redundant : warned;
    in_line.failures = {singular};
    family.add_run(
        "three rods in a line", "height 1e-15", {precision}, in_line, [] { return rods_in_line("1e-15"); },
        {"hbvm:4,2", "auto", "1/32", "1"}, energy);
  }
  family.add_run(
      "doubled rod", "", all_precisions, redundant, [] { return doubled_rod("0"); }, {"hbvm:4,2", "auto", "1/32", "1"},
      accuracy_and_warnings);
  family.add_run(
      "doubled rod", "lengths 1 and 1.001", all_precisions, {false, {"refused"}, {}, {}},
      [] { return doubled_rod("1/1000"); }, {"hbvm:4,2", "auto", "1/32", "1"}, energy);
}

}  // namespace hbvm::core

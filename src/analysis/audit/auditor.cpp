#include "auditor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hbvm/reference/closed_form.hpp"
#include "hbvm/scalar/with_scalar.hpp"
#include "measurements.hpp"

namespace hbvm {
namespace {

/// Precisions in the order in which they are tried.
constexpr std::string_view precisions[] = {"double", "quad", "mpfr:50", "mpfr:100", "mpfr:200", "mpfr:400"};
/// Of the errors of one step, at least so many; of what is conserved to round-off, exactly so many.
constexpr std::size_t deep = 4;

/// What is 0 but for round-off may be so many units off: a few for each of a few hundred operations whose errors meet.
constexpr double allowed_units = 1 << 10;
/// Of a tableau's conditions, for each of its stages: every entry is rounded once, and each condition is a short sum.
constexpr double allowed_ulps_a_stage = 2;

/// By how much the rate of what is measured exceeds the rate that is claimed.
double offset(const Claim& claim) { return claim.tableau && claim.span == Span::interval ? 1 : 0; }

}  // namespace

Auditor::Kind Auditor::kind_of(const Claim& claim) {
  switch (claim.quantity) {
    case Quantity::B:
    case Quantity::C:
    case Quantity::D:
    case Quantity::X:
    case Quantity::symmetry:
    case Quantity::W:
      return claim.tableau ? Kind::special : Kind::tableau;
    case Quantity::order_conditions:
    case Quantity::hidden_constant:
    case Quantity::hidden_drift:
    case Quantity::sweeps:
      return Kind::special;
    default:
      break;
  }
  if (claim.form == Form::round_off) return Kind::round_off;
  // The order of a Runge-Kutta method is that of its local error less one, which shows far smaller flaws.
  return claim.span == Span::step || claim.tableau ? Kind::step : Kind::interval;
}

Auditor::Auditor(const std::vector<Claim>& claims, const Unit& unit, const AuditOptions& options,
                 std::vector<Finding>& findings)
    : unit_(unit), options_(options), findings_(findings) {
  for (const std::size_t i : unit.members) cell_.claims.push_back(claims[i]);
  cell_.first_start = options.first_start;
  cell_.starts = options.starts;
  cell_.log2_interval = options.log2_interval;
}

void Auditor::work() {
  for (std::size_t c = 0; c < cell_.claims.size(); ++c) finding(c).reference = reference();
  switch (unit_.kind) {
    case Kind::step:
      return follow_steps();
    case Kind::interval:
      follow_intervals();
      return compare_with_one_step();
    case Kind::round_off:
      return conserve();
    case Kind::tableau:
      return check_tableau();
    case Kind::special:
      return measure_special();
  }
}

std::string Auditor::reference() const {
  const Claim& subject = cell_.subject();
  switch (unit_.kind) {
    case Kind::round_off:
      return "the start";
    case Kind::tableau:
      return "the condition, in twice the digits";
    case Kind::special:
      return subject.quantity == Quantity::hidden_constant ? "the leading term" : "the run itself";
    default:
      break;
  }
  if (has_closed_form(subject.problem)) return "closed form";
  return "Gauss methods of " + std::to_string(cell_.stages() + 4) + " stages or more";
}

template <class Measure>
void Auditor::climb(std::size_t at_least, const Measure& measure) {
  for (std::size_t level = 0; level < std::size(precisions); ++level) {
    const Precision precision = Precision::parse(precisions[level]);
    const Ladders ladders = with_scalar(precision, measure);
    bool decided = true;
    for (std::size_t c = 0; c < cell_.claims.size(); ++c) {
      Finding& f = finding(c);
      const auto ladder = ladders.find(f.claim.quantity);
      if (ladder == ladders.end()) {
        f.precision = precision.name();
        f.verdict = Verdict::undecidable;
        f.reason = "the quantity does not exist on this problem";
        if (!ladders.empty()) continue;
        // Steps that are all too long for a fast motion say nothing; but the shortest one step must be possible.
        f.verdict = unit_.kind == Kind::step ? Verdict::fails : Verdict::undecidable;
        f.reason = unit_.kind == Kind::step ? "no step can be made: the stage equations have no solution that is found"
                                            : "all steps are too long for the motion: no run could be made";
        continue;
      }
      f.evidence.push_back({precision.name(), ladder->second});
      take(f, ladder->second, precision);
      decided = decided && f.verdict == Verdict::holds;
    }
    if (level + 1 < at_least || precision.digits() < least_digits()) continue;
    if (decided || (level + 1 >= deep && none_is_open(ladders))) return;
  }
}

void Auditor::follow_steps() {
  climb(deep, [&]<Scalar S>() {
    return step_ladder<S>(cell_, [&](const Ladders& ladders) { return cell_.is_lost(ladders); });
  });
}

void Auditor::follow_intervals() {
  const auto holds = [](const Ladders& ladders, const Claim& claim) {
    const auto ladder = ladders.find(claim.quantity);
    return ladder != ladders.end() && judge(claim, convergence_rate(ladder->second)) == Verdict::holds;
  };
  climb(1, [&]<Scalar S>() {
    return interval_ladder<S>(cell_, options_.most_steps, [&](const Ladders& ladders) {
      return cell_.is_lost(ladders) || std::all_of(cell_.claims.begin(), cell_.claims.end(),
                                                   [&](const Claim& claim) { return holds(ladders, claim); });
    });
  });
}

unsigned Auditor::least_digits() const {
  unsigned digits = 0;
  for (const Claim& claim : cell_.claims) digits = std::max(digits, claim.least_digits);
  return digits;
}

bool Auditor::none_is_open(const Ladders& ladders) {
  for (std::size_t c = 0; c < cell_.claims.size(); ++c)
    if (finding(c).verdict == Verdict::undecidable && ladders.contains(finding(c).claim.quantity)) return false;
  return true;
}

void Auditor::take(Finding& f, const std::vector<Rung>& rungs, const Precision& precision) {
  f.precision = precision.name();
  std::optional<Rate> rate = convergence_rate(rungs);
  if (!rate) {
    // An error that no step brings above the round-off of so many digits is O(h^rate) for any rate.
    const bool none =
        std::none_of(rungs.begin(), rungs.end(), [](const Rung& r) { return r.is_clean() || r.by_reference; });
    const bool vanishes = none && !rungs.empty() && f.claim.form == Form::at_least && precision.digits() >= 100;
    f.verdict = vanishes ? Verdict::holds : Verdict::undecidable;
    f.measured = f.uncertainty = std::numeric_limits<double>::quiet_NaN();
    f.reason = vanishes ? "the error is round-off" : "no five errors above round-off";
    return;
  }
  f.measured = rate->value - offset(f.claim);
  f.uncertainty = rate->uncertainty;
  rate->value = f.measured;
  f.verdict = judge(f.claim, rate);
  f.reason = f.verdict == Verdict::undecidable ? "the slope is not settled"
             : f.verdict == Verdict::fails     ? "the error has another rate"
                                               : "";
}

void Auditor::compare_with_one_step() {
  const Precision precision = Precision::parse(precisions[deep - 1]);
  const Ladders ladders = with_scalar(precision, [&]<Scalar S>() {
    return step_ladder<S>(cell_, [&](const Ladders& so_far) { return cell_.is_lost(so_far); });
  });
  for (std::size_t c = 0; c < cell_.claims.size(); ++c) {
    Finding& f = finding(c);
    const auto ladder = ladders.find(f.claim.quantity);
    if (f.verdict != Verdict::holds || ladder == ladders.end()) continue;
    const std::optional<Rate> rate = convergence_rate(ladder->second);
    Claim at_least = f.claim;
    at_least.form = Form::at_least;
    if (judge(at_least, rate) != Verdict::fails) continue;
    f.verdict = Verdict::fails;
    f.precision = precision.name();
    f.measured = rate->value;
    f.uncertainty = rate->uncertainty;
    f.evidence.push_back({precision.name(), ladder->second});
    f.reason = "the error of one step, at steps far smaller, has this rate only";
  }
}

void Auditor::conserve() {
  for (std::size_t level = 0; level < deep; ++level) {
    const Precision precision = Precision::parse(precisions[level]);
    std::map<Quantity, RoundOff> measured;
    try {
      measured = with_scalar(precision, [&]<Scalar S>() { return round_off<S>(cell_); });
    } catch (const StageFailure& failure) {
      for (std::size_t c = 0; c < cell_.claims.size(); ++c)
        settle(c, precision, {}, std::string("a step could not be made: ") + failure.what());
      continue;
    }
    for (std::size_t c = 0; c < cell_.claims.size(); ++c) {
      const auto found = measured.find(finding(c).claim.quantity);
      if (found == measured.end()) {
        settle(c, precision, {}, "there is nothing to measure on this problem");
        continue;
      }
      finding(c).evidence.push_back({precision.name(), {found->second.rung}});
      settle(c, precision, found->second.units, {}, allowed_units);
    }
  }
}

void Auditor::check_tableau() {
  const int stages = cell_.subject().method.k;
  for (std::size_t level = 0; level < deep; ++level) {
    const Precision precision = Precision::parse(precisions[level]);
    const auto defects = with_scalar(precision, [&]<Scalar S>() { return tableau_defects<S>(cell_.subject()); });
    for (std::size_t c = 0; c < cell_.claims.size(); ++c)
      settle(c, precision, defects.at(finding(c).claim.quantity), {}, allowed_ulps_a_stage * stages);
  }
}

void Auditor::measure_special() {
  Finding& f = finding(0);
  f.precision = f.claim.tableau || f.claim.quantity == Quantity::hidden_constant ? "mpfr:100" : "double";
  try {
    f.measured = special_value(f.claim);
  } catch (const StageFailure& failure) {
    f.reason = std::string("a step could not be made: ") + failure.what();
    return;
  }
  f.uncertainty = f.claim.tolerance;
  const double miss =
      f.claim.form == Form::at_least ? f.claim.predicted - f.measured : std::abs(f.measured - f.claim.predicted);
  f.verdict = miss <= f.claim.tolerance ? Verdict::holds : Verdict::fails;
  if (f.verdict == Verdict::fails)
    f.reason = f.claim.quantity == Quantity::C ? "c is not the sum of the rows of A"
               : f.claim.quantity == Quantity::order_conditions
                   ? order_flaw(*f.claim.tableau, static_cast<int>(f.measured))
                   : "the value is another";
}

void Auditor::settle(std::size_t c, const Precision& precision, std::optional<double> units, const std::string& reason,
                     double allowed) {
  Finding& f = finding(c);
  f.precision = precision.name();
  if (!units) {
    if (f.verdict != Verdict::fails) {
      f.verdict = Verdict::undecidable;
      f.reason = reason;
    }
    return;
  }
  f.uncertainty = allowed;
  f.measured = std::max(f.measured, *units);
  f.verdict = f.measured <= allowed ? Verdict::holds : Verdict::fails;
  f.reason = f.verdict == Verdict::fails ? "it is more than round-off" : "";
}

}  // namespace hbvm

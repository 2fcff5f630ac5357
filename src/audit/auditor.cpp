#include "auditor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <numbers>

#include "clock.hpp"
#include "exactness.hpp"
#include "interruption.hpp"
#include "measurements.hpp"
#include "method/order_conditions.hpp"
#include "scalar/literal.hpp"
#include "scalar/text.hpp"
#include "scalar/with_scalar.hpp"
#include "step/hbvm_method.hpp"
#include "step/tableau_method.hpp"
#include "typo.hpp"
#include "weak_terms.hpp"

namespace hbvm::core {
namespace {

/// Precisions in the order in which they are tried.
const std::string_view precisions[] = {"double",  precision_of_34_digits(), "mpfr:50", "mpfr:100", "mpfr:200",
                                       "mpfr:400"};
/// Of the errors of one step, at least so many; of what is conserved to round-off, exactly so many.
constexpr std::size_t deep = 4;

/// What is claimed to be exact is looked at over so many steps of 2^-4 of the time scale.
constexpr ConservationRun short_steps{-4, 16};
/// And where an error could hide, in more digits, over some of half the time scale; not in more digits than these.
constexpr ConservationRun long_steps{-1, 4};
constexpr int most_digits = 3'000;

/// Of a tableau's conditions, for each of its stages: every entry is rounded once, and each condition is a short sum.
constexpr double allowed_ulps_a_stage = 2;
/// Conditions that hold to so many digits are meant to hold.
constexpr int meant_digits = 10;

bool is_tableau(const Claim& claim) { return as_tableau(*claim.method) != nullptr; }

/// By how much the rate of what is measured exceeds the rate that is claimed.
double offset(const Claim& claim) { return is_tableau(claim) && claim.span == Span::interval ? 1 : 0; }

/// Which rows of A do not sum to c, of those that miss it by most: "; row 5 sums to 0.888, c[5] is 0.889".
std::string wrong_rows(const Tableau& tableau, const Met& met) {
  const PrecisionScope scope(60);
  const RungeKutta<Mpfr> method = make_runge_kutta<Mpfr>(tableau);
  std::string text;
  int named = 0;
  for (Index i = 0; i < method.c.size(); ++i) {
    Mpfr sum = 0;
    for (Index j = 0; j < method.c.size(); ++j) sum += method.A(i, j);
    if (magnitude(Mpfr(sum - method.c[i])) < pow(Mpfr(10), -std::min(met.due, 55))) continue;
    constexpr int most = 3;
    if (++named > most) return text + " and more";
    const int shown = std::clamp(met.seen + 4, 6, 50);
    text += "; row " + std::to_string(i + 1) + " sums to " + to_scientific(sum, shown) + ", c[" +
            std::to_string(i + 1) + "] is " + to_scientific(method.c[i], shown);
  }
  return text;
}

/// The first of them that holds the numbers of a scene: 1e-420 is none of double.
std::size_t first_level(const std::string& problem) {
  const Scene scene = load_scene(problem);
  for (std::size_t level = 0; level < std::size(precisions); ++level) try {
      with_scalar(Precision::parse(precisions[level]), [&]<Scalar S>() { assemble<S>(scene, Consistency::unchecked); });
      return level;
    } catch (const InputError&) {  // told of the first one if none does
    }
  return 0;
}

bool is_rate(const Claim& claim) { return claim.form == Form::at_least || claim.form == Form::exactly; }

}  // namespace

Motion Motions::of(const std::string& problem) {
  const std::lock_guard lock(mutex_);
  const auto place = known_.find(problem);
  return place != known_.end() ? place->second : known_.emplace(problem, motion_of(problem)).first->second;
}

Auditor::Kind Auditor::kind_of(const Claim& claim) {
  // Conditions on coefficients are the last quantities, and what has no rate stands before them.
  if (claim.quantity >= Quantity::B) return is_tableau(claim) ? Kind::special : Kind::tableau;
  if (claim.quantity >= Quantity::hidden_constant) return Kind::special;
  return claim.form == Form::round_off ? Kind::round_off : claim.form == Form::digits ? Kind::digits : Kind::rates;
}

Auditor::Auditor(const std::vector<Claim>& claims, const Unit& unit, const AuditOptions& options, Motions& motions,
                 std::vector<Finding>& findings)
    : unit_(unit), options_(options), motions_(motions), findings_(findings) {
  for (const std::size_t i : unit.members) {
    const Claim& claim = claims[i];
    // The order of a Runge-Kutta method is that of its local error less one, which shows far smaller flaws.
    (claim.span == Span::step || is_tableau(claim) ? steps_ : intervals_).push_back(group_.claims.size());
    group_.claims.push_back(claim);
  }
}

void Auditor::work() {
  const double began = thread_seconds();
  if (options_.limit > 0) group_.stop_at = began + options_.limit * static_cast<double>(group_.claims.size());
  const auto give_up = [&](Verdict verdict, const std::string& reason) {
    for (std::size_t c = 0; c < group_.claims.size(); ++c) {
      if (settled_.contains(c)) continue;
      finding(c).verdict = verdict;
      finding(c).reason = reason;
    }
  };
  try {
    prepare();
    decide();
  } catch (const Interrupted&) {
    throw;
  } catch (const LimitReached&) {
    give_up(Verdict::undecidable, "not decided in the time there is, see --limit");
  } catch (const std::bad_alloc&) {
    give_up(Verdict::not_run, "out of memory");
  } catch (const Error& error) {
    give_up(Verdict::not_run, error.what());
  }
  for (std::size_t c = 0; c < group_.claims.size(); ++c) {
    weigh(finding(c));
    finding(c).seconds = thread_seconds() - began;
  }
}

void Auditor::prepare() {
  for (std::size_t c = 0; c < group_.claims.size(); ++c) finding(c).reference = reference();
  if (options_.coefficient_digits > 0 && CoefficientCheck::is_for(*group_.subject().method)) {
    coefficients_.emplace(group_.subject(), options_.coefficient_digits);
    group_.check_time();
    // A unit in the last digit, where half of one is as far as a right digit is off.
    if (const auto& decimals = coefficients_->decimals())
      group_.log2_rounding = -decimals->digits * std::numbers::ln10 / std::numbers::ln2;
  }
  group_.starts.count = options_.starts;
  group_.starts.lead += options_.first_start * group_.starts.stride;
  if (unit_.kind == Kind::tableau || unit_.kind == Kind::special) return;
  const std::string& problem = group_.subject().problem;
  motion_ = motions_.of(problem);
  if (motion_.has_closed_form && unit_.kind == Kind::rates)
    for (std::size_t c = 0; c < group_.claims.size(); ++c) finding(c).reference = "closed form";
  group_.log2_scale = motion_.log2_scale;
  group_.log2_interval = options_.log2_interval;
  const double eighth = std::exp2(group_.log2_scale - 3), window = std::exp2(group_.log2_scale + group_.log2_interval);
  if (options_.until) {
    // The starts share the time between them, and each goes on to the next.
    const PrecisionScope scope(30);
    const double until = approximately(evaluate<Mpfr>(*options_.until));
    const double share = until / group_.starts.count;
    group_.windows = std::max(1L, std::lround(std::ceil(share / window)));
    group_.starts.lead = 0;
    group_.starts.stride = std::max(1L, std::lround(share / eighth));
  }
  const auto at = [&](long n) { return static_cast<double>(n) * eighth; };
  const double last = at(group_.starts.lead + (group_.starts.count - 1) * group_.starts.stride);
  for (std::size_t c = 0; c < group_.claims.size(); ++c) {
    const bool one_step = is_rate(finding(c).claim) && finding(c).claim.span == Span::step;
    finding(c).interval =
        Interval{at(group_.starts.lead), last + (one_step ? 2 * eighth : window * static_cast<double>(group_.windows))};
  }
}

void Auditor::decide() {
  switch (unit_.kind) {
    case Kind::rates:
      if (!steps_.empty()) follow_steps();
      settled_.insert(steps_.begin(), steps_.end());
      if (!intervals_.empty()) follow_intervals();
      return;
    case Kind::round_off:
      return conserve();
    case Kind::tableau:
      return check_tableau();
    case Kind::special:
      return measure_special();
    case Kind::digits:
      return count_digits();
  }
}

std::string Auditor::reference() const {
  const Claim& subject = group_.subject();
  switch (unit_.kind) {
    case Kind::round_off:
      return "the start";
    case Kind::tableau:
      return "the condition, in twice the digits";
    case Kind::special:
      return subject.quantity == Quantity::hidden_constant ? "the leading term" : "the run itself";
    case Kind::rates:
    case Kind::digits:
      break;
  }
  return "Gauss methods of " + std::to_string(group_.stages() + 4) + " stages or more";
}

std::vector<Precision> Auditor::levels() const {
  std::vector<Precision> result;
  for (const std::string_view name : precisions) {
    result.push_back(Precision::parse(name));
    // One that has all their digits, and six more.
    constexpr unsigned more = 6;
    if (coefficients_ && coefficients_->decimals() &&
        result.back().digits() >= static_cast<unsigned>(coefficients_->decimals()->digits) + more &&
        result.size() > first_level(group_.subject().problem))
      break;
  }
  return result;
}

std::string Auditor::decimals_text() const {
  const Decimals& decimals = *coefficients_->decimals();
  return "the numbers are decimals of " + std::to_string(decimals.digits) + " digits and held to these; " +
         decimals.example +
         (decimals.fraction ? ", written as " + *decimals.fraction + ", would be exact"
                            : ", written as an expression like 1/6 or (3-sqrt(3))/6, would be exact");
}

std::string Auditor::near_the_start() const {
  return "from " + std::to_string(group_.starts.count) + (group_.starts.count == 1 ? " state" : " states") +
         (options_.until ? " on the way" : " near the start");
}

template <class Measure>
void Auditor::climb(const std::vector<std::size_t>& members, std::size_t at_least, const Measure& measure) {
  const std::vector<Precision> all = levels();
  at_least = std::min(at_least, all.size());
  for (std::size_t level = first_level(group_.subject().problem); level < all.size(); ++level) {
    const Precision& precision = all[level];
    const Ladders ladders = with_scalar(precision, measure);
    if (level + 1 == std::min(deep, all.size()) && !steps_.empty() && &members == &steps_) deep_ = ladders;
    bool decided = true, open = false;
    for (const std::size_t c : members) {
      Finding& f = finding(c);
      f.precision = precision.name();
      const auto ladder = ladders.find(f.claim.quantity);
      if (ladder == ladders.end()) {
        f.verdict = ladders.empty() ? Verdict::not_run : Verdict::undecidable;
        f.reason = ladders.empty() ? "no step could be made: the stage equations have no solution that is found"
                                   : "the quantity does not exist on this problem";
        decided = decided && !ladders.empty();
        continue;
      }
      f.evidence.push_back({precision.name(), ladder->second});
      take(f, ladder->second, precision);
      decided = decided && f.verdict == Verdict::holds;
      open = open || f.verdict == Verdict::undecidable;
    }
    if (level + 1 < at_least || precision.digits() < least_digits()) continue;
    if (decided || (level + 1 >= deep && !open)) return;
  }
}

void Auditor::follow_steps() {
  climb(steps_, deep, [&]<Scalar S>() {
    return step_ladder<S>(group_, [&](const Ladders& ladders) { return group_.is_lost(ladders); });
  });
}

void Auditor::follow_intervals() {
  ClaimGroup group = group_;
  group.claims.clear();
  for (const std::size_t c : intervals_) group.claims.push_back(group_.claims[c]);
  const auto holds = [](const Ladders& ladders, const Claim& claim) {
    const auto ladder = ladders.find(claim.quantity);
    return ladder != ladders.end() && judge(claim, convergence_rate(ladder->second)) == Verdict::holds;
  };
  climb(intervals_, 1, [&]<Scalar S>() {
    return interval_ladder<S>(group, options_.most_steps, [&](const Ladders& ladders) {
      return group.is_lost(ladders) || std::all_of(group.claims.begin(), group.claims.end(),
                                                   [&](const Claim& claim) { return holds(ladders, claim); });
    });
  });
  compare_with_one_step();
}

unsigned Auditor::least_digits() const {
  unsigned digits = 0;
  for (const Claim& claim : group_.claims) digits = std::max(digits, claim.least_digits);
  return digits;
}

void Auditor::take(Finding& f, const std::vector<Rung>& rungs, const Precision& precision) {
  std::optional<Rate> rate = convergence_rate(rungs);
  if (!rate) {
    // An error that no step brings above the round-off of so many digits is O(h^rate) for any rate.
    const bool none =
        std::none_of(rungs.begin(), rungs.end(), [](const Rung& r) { return r.is_clean() || r.by_reference; });
    const bool vanishes = none && !rungs.empty() && f.claim.form == Form::at_least && precision.digits() >= 100;
    f.verdict = vanishes ? Verdict::holds : Verdict::undecidable;
    f.measured = f.uncertainty = std::numeric_limits<double>::quiet_NaN();
    f.reason = vanishes ? "sampled: the error is round-off, " + near_the_start() : "no five errors above round-off";
    if (!vanishes && coefficients_ && coefficients_->decimals()) f.reason += "; " + decimals_text();
    return;
  }
  f.measured = rate->value - offset(f.claim);
  f.uncertainty = rate->uncertainty;
  rate->value = f.measured;
  f.verdict = judge(f.claim, rate);
  f.reason = f.verdict == Verdict::undecidable ? "the slope is not settled"
             : f.verdict == Verdict::fails
                 ? "the error has another rate"
                 : "sampled: the slopes settle over " + std::to_string(std::lround(rate->halvings)) +
                       " halvings of the step, " + near_the_start();
}

void Auditor::compare_with_one_step() {
  const std::vector<Precision> all = levels();
  const Precision precision = all[std::min(deep, all.size()) - 1];
  if (!deep_) {
    deep_ = with_scalar(precision, [&]<Scalar S>() {
      return step_ladder<S>(group_, [&](const Ladders& so_far) { return group_.is_lost(so_far); });
    });
  }
  for (const std::size_t c : intervals_) {
    Finding& f = finding(c);
    const auto ladder = deep_->find(f.claim.quantity);
    if (f.verdict != Verdict::holds || ladder == deep_->end()) continue;
    if (Precision::parse(f.precision).digits() < precision.digits()) f.precision = precision.name();
    const std::optional<Rate> rate = convergence_rate(ladder->second);
    Claim at_least = f.claim;
    at_least.form = Form::at_least;
    if (judge(at_least, rate) != Verdict::fails) continue;
    f.measured = rate->value;
    f.uncertainty = rate->uncertainty;
    f.evidence.push_back({precision.name(), ladder->second});
    fail(f, "the error of one step, at steps far smaller, has this rate only");
  }
}

void Auditor::conserve_in(const Precision& precision, int log2_step, long steps) {
  const auto measured = with_scalar(precision, [&]<Scalar S>() { return round_off<S>(group_, {log2_step, steps}); });
  for (std::size_t c = 0; c < group_.claims.size(); ++c) {
    Finding& f = finding(c);
    f.precision = precision.name();
    const auto found = measured.find(f.claim.quantity);
    if (found == measured.end()) {
      f.verdict = Verdict::undecidable;
      f.reason = "there is nothing to measure on this problem";
      continue;
    }
    const RoundOff& own = found->second;
    f.evidence.push_back({precision.name(), {own.rung}});
    f.uncertainty = allowed_units(f.claim);
    f.measured = std::max(f.measured, own.ratio * f.uncertainty);
    if (own.ratio > 1) {
      fail(f, "it is more than round-off");
      settled_.insert(c);
    } else if (f.verdict != Verdict::fails) {
      f.verdict = Verdict::holds;
    }
  }
}

void Auditor::conserve() {
  const std::vector<Precision> all = levels();
  for (std::size_t level = first_level(group_.subject().problem); level < std::min(deep, all.size()); ++level)
    conserve_in(all[level], short_steps.log2_step, short_steps.steps * group_.windows);
  int digits = 0;
  std::vector<std::size_t> unproved;
  for (std::size_t c = 0; c < group_.claims.size(); ++c) {
    if (finding(c).verdict != Verdict::holds) continue;
    finding(c).reason = proof_of(finding(c).claim, coefficients_ ? &*coefficients_ : nullptr);
    if (!finding(c).reason.empty()) continue;
    if (coefficients_ && coefficients_->decimals()) {
      finding(c).reason = "sampled: no error above the round-off of " + finding(c).precision + ", " + near_the_start() +
                          "; " + decimals_text();
      continue;
    }
    unproved.push_back(c);
    digits = std::max(digits, digits_to_show(finding(c).claim, group_.log2_scale));
  }
  if (unproved.empty()) return;
  const int shown = std::clamp(digits, 100, most_digits);
  const Precision precision = Precision::parse("mpfr:" + std::to_string(shown));
  constexpr int shorter = 2;
  for (int halvings = 0;; ++halvings) try {
      conserve_in(precision, long_steps.log2_step - halvings, long_steps.steps);
      break;
    } catch (const StageFailure&) {
      if (halvings == shorter) throw;
    }
  for (const std::size_t c : unproved) {
    Finding& f = finding(c);
    if (f.verdict != Verdict::holds) continue;
    f.reason = "sampled: no error in " + std::to_string(shown) +
               " digits, where one of the method's order would show if no term is weaker than the rest by 10^-" +
               std::to_string(digits_of_terms) + ", " + near_the_start();
    if (digits <= shown) continue;
    f.verdict = Verdict::undecidable;
    f.reason =
        "an error would show in " + std::to_string(digits) + " digits, and " + std::to_string(shown) + " are looked at";
  }
}

void Auditor::check_tableau() {
  const HbvmMethod* const hbvm = as_hbvm(*group_.subject().method);
  if (!hbvm) throw InputError("the coefficients of " + group_.subject().method_text() + " have no such conditions");
  const int stages = hbvm->name().k;
  for (std::size_t level = 0; level < deep; ++level) {
    const Precision precision = Precision::parse(precisions[level]);
    const auto units = with_scalar(precision, [&]<Scalar S>() {
      auto defects = tableau_defects<S>(group_.subject());
      for (auto& [quantity, defect] : defects) defect = std::exp2(defect - (1 - significand_bits<S>()));
      return defects;
    });
    for (std::size_t c = 0; c < group_.claims.size(); ++c) {
      Finding& f = finding(c);
      f.precision = precision.name();
      f.uncertainty = allowed_ulps_a_stage * stages;
      f.measured = std::max(f.measured, units.at(f.claim.quantity));
      if (f.verdict == Verdict::fails) continue;
      if (f.measured <= f.uncertainty) {
        f.verdict = Verdict::holds;
        f.reason = "the conditions are met in double, " + std::string(precision_of_34_digits()) + " and to " +
                   std::to_string(precision.digits()) + " digits";
      } else {
        fail(f, "it is more than round-off");
      }
    }
  }
}

void Auditor::count_digits() {
  constexpr int more = 20;
  constexpr long most_steps_of_a_window = 16;
  double asked = 0;
  for (const Claim& claim : group_.claims) asked = std::max(asked, claim.predicted);
  const Precision precision = Precision::parse("mpfr:" + std::to_string(static_cast<int>(std::ceil(asked)) + more));
  const Ladders ladders = with_scalar(precision, [&]<Scalar S>() {
    return interval_ladder<S>(group_, most_steps_of_a_window, [](const Ladders&) { return false; });
  });
  for (std::size_t c = 0; c < group_.claims.size(); ++c) {
    Finding& f = finding(c);
    f.precision = precision.name();
    const auto ladder = ladders.find(f.claim.quantity);
    if (ladder == ladders.end()) {
      f.verdict = ladders.empty() ? Verdict::not_run : Verdict::undecidable;
      f.reason = ladders.empty() ? "no step could be made" : "the quantity does not exist on this problem";
      continue;
    }
    f.evidence.push_back({precision.name(), ladder->second});
    double greatest = -std::numeric_limits<double>::infinity();
    for (const Rung& rung : ladder->second) greatest = std::max(greatest, rung.error);
    f.measured = -greatest * std::numbers::ln2 / std::numbers::ln10;
    if (f.measured >= f.claim.predicted) {
      f.verdict = Verdict::holds;
      f.reason = "sampled: so many digits are right at each step, " + near_the_start();
    } else {
      fail(f, "fewer digits are right");
    }
  }
}

void Auditor::measure_special() {
  Finding& f = finding(0);
  if (is_tableau(f.claim)) return measure_tableau();
  f.precision = f.claim.quantity == Quantity::hidden_constant ? "mpfr:100" : "double";
  f.measured = special_value(group_);
  f.uncertainty = f.claim.tolerance;
  const double miss =
      f.claim.form == Form::at_least ? f.claim.predicted - f.measured : std::abs(f.measured - f.claim.predicted);
  f.verdict = miss <= f.claim.tolerance ? Verdict::holds : Verdict::fails;
  f.reason = f.verdict == Verdict::fails ? "the value is another" : "sampled: one run has this value";
}

void Auditor::measure_tableau() {
  Finding& f = finding(0);
  if (!coefficients_) coefficients_.emplace(f.claim, 100);
  const CoefficientCheck& check = *coefficients_;
  f.precision = "mpfr:" + std::to_string(check.digits());
  switch (f.claim.quantity) {
    case Quantity::order_conditions:
      f.measured = check.order_found();
      break;
    case Quantity::B:
      f.measured = check.B_found();
      break;
    case Quantity::C:
      f.measured = check.C_found();
      break;
    case Quantity::D:
      f.measured = check.D_found();
      break;
    case Quantity::symmetry:
      f.verdict = check.symmetry().holds() ? Verdict::holds : Verdict::fails;
      f.reason = "the coefficients are symmetric to " + std::to_string(check.symmetry().seen) + " digits";
      return;
    default:
      throw InputError("the coefficients of " + f.claim.method_text() + " have no such conditions");
  }
  const int found = static_cast<int>(f.measured);
  const bool holds = f.claim.form == Form::exactly ? f.measured == f.claim.predicted : f.measured >= f.claim.predicted;
  f.verdict = holds ? Verdict::holds : Verdict::fails;
  if (f.claim.quantity == Quantity::order_conditions) {
    // Of an order that nobody states.
    const bool unstated = holds && !as_tableau(*f.claim.method)->tableau().order;
    const Tableau& tableau = as_tableau(*f.claim.method)->tableau();
    if (unstated && found == 0) f.verdict = Verdict::fails;
    const int meant = check.decimals() ? std::clamp(check.decimals()->digits - 4, 1, meant_digits) : meant_digits;
    const auto typo = f.verdict == Verdict::fails || unstated ? typo_of(tableau, found, meant) : std::nullopt;
    const bool nearly = unstated && is_nearly_of_next_order(tableau, found);
    if (unstated && (typo || nearly)) f.verdict = Verdict::fails;
    // By the trees alone no more can be told of a method that has a higher order by other conditions.
    if (!holds && found == deciding_tree_order && f.claim.form == Form::at_least) {
      f.verdict = Verdict::undecidable;
      f.reason = "the conditions of all trees, to order " + std::to_string(deciding_tree_order) +
                 ", are met; higher ones are looked at by B, C and D alone, which a method need not meet";
    } else {
      f.reason = words_on_order(f, found);
      if (typo)
        f.reason += ": it looks like a typo, since those of order " + std::to_string(typo->order) + " are met if " +
                    typo->entry + " is " + typo->expected + " in place of " + typo->written;
      else if (nearly)
        f.reason += ": far better than by chance, it looks like a typo";
    }
  } else if (holds) {
    f.reason = "the conditions hold to the power " + std::to_string(found) + ", and no further";
  } else if (f.claim.quantity == Quantity::C && found == 0) {
    f.reason = "c is the sum of the rows of A to " + std::to_string(check.row_sums().seen) + " digits only" +
               wrong_rows(as_tableau(*f.claim.method)->tableau(), check.row_sums());
  } else {
    f.reason = "the conditions hold to the power " + std::to_string(found) + " only";
  }
  if (check.decimals()) f.reason += "; " + decimals_text();
}

std::string Auditor::words_on_order(const Finding& f, int found) const {
  const int next = found + 1;
  std::string missed = "the conditions of order " + std::to_string(next) + " are met to " +
                       std::to_string(coefficients_->order(next).seen) + " digits only";
  if (f.claim.predicted > found) return missed;
  const std::string to = coefficients_->decimals() && found > 0
                             ? ", its conditions met to " + std::to_string(coefficients_->order(found).seen) + " digits"
                             : "";
  return "order " + std::to_string(found) + " found" + to + "; " + missed;
}

void Auditor::fail(Finding& f, const std::string& reason) {
  f.verdict = Verdict::fails;
  f.reason = reason;
}

void Auditor::weigh(Finding& f) {
  if (coefficients_) weigh_coefficients(f);
  if (f.verdict != Verdict::holds && f.verdict != Verdict::undecidable) return;
  if (f.claim.of_degenerate_motion || unit_.kind == Kind::tableau || unit_.kind == Kind::special) return;
  const bool no_turn = motion_.straight && f.claim.quantity == Quantity::angular_momentum;
  if (motion_.degenerate.empty() && !no_turn) return;
  f.verdict = Verdict::degenerate;
  f.reason = "the motion says nothing of the method: " +
             (motion_.degenerate.empty() ? "every body moves on a straight line" : motion_.degenerate);
}

void Auditor::weigh_coefficients(Finding& f) {
  const CoefficientCheck& check = *coefficients_;
  if (!is_tableau(f.claim)) {
    f.coefficients_to = check.definition();
    if (f.verdict == Verdict::holds && check.definition() < check.digits())
      fail(f, "the coefficients are right to " + std::to_string(check.definition()) + " digits only");
    return;
  }
  const double order = f.claim.span == Span::step ? f.claim.predicted - 1 : f.claim.predicted;
  const int meant = check.decimals() ? std::clamp(check.decimals()->digits - 4, 1, meant_digits) : meant_digits;
  const int shown = check.order_to(meant);
  // What the claim needs, as far as it is meant to be there; an order above that is due to the problem.
  const bool is_order = is_rate(f.claim) && f.claim.quantity < Quantity::hidden_constant;
  const bool of_order = is_order || f.claim.quantity == Quantity::order_conditions;
  Met met = check.order(of_order ? std::min(static_cast<int>(std::ceil(order)), shown) : shown);
  const auto also = [&](const Met& own) {
    if (own.seen < meant) return;
    met = {std::min(met.seen, own.seen), std::min(met.due, own.due)};
    if (!own.holds()) met.due = met.seen + 1;
  };
  switch (f.claim.quantity) {
    case Quantity::angular_momentum:
      also(check.symplecticity());
      break;
    case Quantity::reversal:
      also(check.symmetry());
      break;
    case Quantity::symmetry:
      met = check.symmetry();
      break;
    case Quantity::C:
      met = check.row_sums();
      break;
    case Quantity::B:
    case Quantity::D:
      return;
    default:
      break;
  }
  f.coefficients_to = met.seen;
  if (f.verdict != Verdict::holds || met.holds()) return;
  fail(f, "the coefficients are right to " + std::to_string(met.seen) + " digits only" +
              (check.decimals() ? ", and its decimals could make it " + std::to_string(met.due) : ""));
}

}  // namespace hbvm::core

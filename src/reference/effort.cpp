#include "reference/effort.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "clock.hpp"
#include "problem/in_double.hpp"
#include "reference/taylor.hpp"
#include "solver/jacobian.hpp"

namespace hbvm::core {
namespace {

/// Seconds that a product of numbers of so many digits takes here and now.
double seconds_of_product(unsigned digits) {
  const PrecisionScope scope(digits);
  Mpfr a = 1, b = 1;
  mpfr_const_pi(raw(a), MPFR_RNDN);
  mpfr_const_log2(raw(b), MPFR_RNDN);
  constexpr int most = 1 << 16;
  constexpr double enough = double{1} / 1000;
  Mpfr c = 0;
  int count = 0;
  const double start = thread_seconds();
  double taken = 0;
  for (int block = 8; taken < enough && count < most; block *= 2) {
    for (int i = 0; i < block; ++i) mpfr_mul(raw(c), raw(a), raw(b), MPFR_RNDN);
    count += block;
    taken = thread_seconds() - start;
  }
  return taken / count;
}

double bytes_of_number(unsigned digits) { return 40 + digits * std::log2(double{10}) / 8; }

/// Products of series, and series, of a program of an effect or constraint.
struct SeriesCount {
  double products = 0, series = 0;
  void add(const Program<Mpfr>& program, double instances) {
    for (const Instruction& i : program.instructions()) {
      series += instances;
      if (i.op != Op::add && i.op != Op::subtract && i.op != Op::negate) products += instances;
    }
  }
};

SeriesCount series_of(const Problem<Mpfr>& problem) {
  SeriesCount count;
  for (const EffectTerm<Mpfr>& term : problem.potential.terms)
    count.add(term.gradient, static_cast<double>(term.instances()));
  for (const Constraint<Mpfr>& constraint : problem.constraints) {
    if (const auto* const formula = std::get_if<FormulaConstraint<Mpfr>>(&constraint.form))
      count.add(formula->term.gradient, 1);
    // Of each coordinate's gradient with the multiplier and with the velocity.
    const auto touched = static_cast<double>(coordinates(constraint, problem.dimension).size());
    count.products += 2 * touched;
    count.series += 2 * touched;
  }
  for (const ForceTerm<Mpfr>& term : problem.forces) count.add(term.force, static_cast<double>(term.instances()));
  for (const DrivenPoint<Mpfr>& point : problem.driven) count.add(point.course, 1);
  count.series += 3 * static_cast<double>(problem.m());
  return count;
}

/// Of the Jacobian of one stage, whose unknowns stand in the order in which the band is narrow.
double half_bandwidth(const Problem<Mpfr>& problem) {
  const Problem<double> rounded = in_double(problem);
  const Hbvm<double> one_stage = make_hbvm<double>(1, 1);
  return static_cast<double>(Jacobian<double>(rounded, one_stage).half_bandwidth());
}

}  // namespace

namespace {

/// \param by_blocks as GrowingConvolution multiplies series
Effort effort_of_series(const Problem<Mpfr>& problem, const MotionNature& nature, unsigned digits, bool by_blocks) {
  const SeriesCount count = series_of(problem);
  // Numbers of a convolution fall to a third on average as AlignedSeries keeps them.
  constexpr double part = double{1} / 3;
  const PrecisionScope scope(digits);
  const auto order = static_cast<double>(TaylorMotion::order_for(significand_bits<Mpfr>()));
  // Blocks gain from such an order on: measured up to four times that.
  constexpr double order_of_blocks = 700, gain = double{12} / 10;
  const double quicker = by_blocks && order > order_of_blocks ? std::pow(order_of_blocks / order, gain) : 1;
  const double a_step = count.products * part * quicker * order * order / 2 * seconds_of_product(digits);
  return {"taylor", nature.steps * a_step, count.series * order * bytes_of_number(digits)};
}

}  // namespace

Effort effort_of_taylor(const Problem<Mpfr>& problem, const MotionNature& nature, unsigned digits) {
  return effort_of_series(problem, nature, digits, true);
}

Effort effort_of_proof(const Problem<Mpfr>& problem, const MotionNature& nature, unsigned digits) {
  // The defect and the growth of errors, step by step: measured, with 200 digits and more.
  constexpr double as_taylor = 5;
  const Effort taylor = effort_of_series(problem, nature, digits, false);
  return {"proof", as_taylor * taylor.seconds, taylor.bytes};
}

Effort effort_of_hbvm(const Problem<Mpfr>& problem, const MotionNature& nature, unsigned digits) {
  const int s = stages_of_route(digits);
  const double unknowns = static_cast<double>(problem.m() + problem.nu()), product = seconds_of_product(digits);
  // A step of a Taylor series is a fifth of its radius of convergence, that of HBVM 16/5 of it by rho, see HbvmMotion.
  const double rho = std::pow(double{10}, static_cast<double>(digits) / (2 * s)), steps = nature.steps * rho / 16;
  const double sweeps = 3 + static_cast<double>(digits) / 15,
               products = 4 * s * s * unknowns + s * series_of(problem).products;
  // The Jacobian in double, and the coefficients of the method.
  constexpr double nanosecond = double{1} / 1'000'000'000, operations = 4;
  const double n = s * unknowns, band = std::min(n, s * (1 + half_bandwidth(problem)));
  const double jacobian = std::min(2 * n * band * band, std::pow(n, 3) / 3) * nanosecond;
  const double setting_up = operations * std::pow(s, 3) * product;
  return {"hbvm", setting_up + steps * (sweeps * products / 2 * product + jacobian),
          (12 * s * s + 20 * s * unknowns) * bytes_of_number(digits) + 8 * n * std::min(3 * band, n)};
}

std::string duration_text(double seconds) {
  struct Unit {
    double seconds;
    const char* name;
  };
  for (const Unit& unit : {Unit{365 * 86400, "years"}, {86400, "days"}, {3600, "hours"}, {60, "minutes"}})
    if (seconds >= 2 * unit.seconds) return fmt::format("{:.3g} {}", seconds / unit.seconds, unit.name);
  return fmt::format("{:.3g} seconds", seconds);
}

}  // namespace hbvm::core

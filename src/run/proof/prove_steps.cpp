#include "prove_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "clock.hpp"
#include "integrate/step_error.hpp"
#include "proved_course.hpp"
#include "reference/proved_states.hpp"
#include "scalar/text.hpp"
#include "step/hbvm_method.hpp"

namespace hbvm::core {
namespace {

Mpfr in_mpfr(arf_srcptr x, mpfr_rnd_t rounding) {
  Mpfr result;
  arf_get_mpfr(raw(result), x, rounding);
  return result;
}

/// Three digits of what is not negative, rounded one way: "3.74e-16".
std::string bound_text(const Mpfr& bound, mpfr_rnd_t rounding) {
  if (bound == 0) return "0";
  if (!is_finite(bound)) return to_text(bound);
  constexpr std::size_t digits = 3, room = 8;
  mpfr_exp_t exponent = 0;
  std::array<char, room> text{};
  mpfr_get_str(text.data(), &exponent, 10, digits, raw(bound), rounding);
  return fmt::format("{}.{}e{:+03}", text.front(), &text[1], exponent - 1);
}
std::string upper_text(const Mpfr& bound) { return bound_text(bound, MPFR_RNDU); }
std::string lower_text(const Mpfr& bound) { return bound == 0 ? "" : bound_text(bound, MPFR_RNDD); }

/// Bounds of the magnitudes of balls: none exceeds `most`, and one of them is at least `least`.
struct Magnitudes {
  Mpfr most = 0, least = 0;

  void add(const RealBall& x) {
    raise_to(most, in_mpfr(arb_midref(raw(greatest_magnitude(x))), MPFR_RNDU));
    raise_to(least, in_mpfr(arb_midref(raw(least_magnitude(x))), MPFR_RNDD));
  }
};

/// Of a vector along the motion: how large it is, and how wide its bounds are.
struct Bounds {
  Mpfr size = 0, radius = 0;

  void add(const std::vector<RealBall>& x) {
    for (const RealBall& component : x) {
      Magnitudes of;
      of.add(component);
      raise_to(size, of.most);
      Mpfr of_component;
      mag_get_mpfr(raw(of_component), component);
      raise_to(radius, of_component);
    }
  }
  static void mag_get_mpfr(mpfr_ptr result, const RealBall& x) {
    RealBall bound;
    arf_set_mag(arb_midref(raw(bound)), arb_radref(raw(x)));
    arf_get_mpfr(result, arb_midref(raw(bound)), MPFR_RNDU);
  }
  /// What hardly differs from 0 is as large as a part of this.
  void raise_size(const RealBall& usual) {
    constexpr int few_bits = 20;
    Mpfr part = in_mpfr(arb_midref(raw(usual)), MPFR_RNDU);
    mpfr_div_2si(raw(part), raw(part), few_bits, MPFR_RNDU);
    raise_to(size, part);
  }
  /// By how many digits the radius exceeds half a unit of the last one.
  double missing(int digits) const {
    using std::log10, std::floor;
    if (radius == 0) return -digits;
    if (!is_finite(radius) || !is_finite(size)) return digits;
    return approximately(Mpfr(log10(Mpfr(2 * radius)) - floor(log10(size)))) + digits - 1;
  }
};

/// One attempt.
class Attempt {
 public:
  Attempt(const StepsToProve& asked, const Assembled<Mpfr>& exact, const Assembled<Mpfr>& rounded,
          const Hbvm<Mpfr>& method, const TimeGrid<Mpfr>& grid)
      : asked_(asked), grid_(grid), problem_(rounded.problem), course_(exact, rounded, method, believed(grid.step())) {
    see();
  }

  /// Makes the steps. \return the digits that are missing, at most 0 if it is a proof. It ends early if some are
  double run() {
    for (long n = 1; n <= grid_.steps(); ++n) {
      make_step(n);
      see();
      if (n == 1) first_ = width();
      const double short_of = missing();
      if (short_of > 0) {
        // The rest of the motion will take as many again.
        const double growth_a_step = n > 1 ? growth() / static_cast<double>(n - 1) : 0;
        return short_of + std::max(double{0}, growth_a_step) * static_cast<double>(grid_.steps() - n);
      }
      if (asked_.progress) asked_.progress(n, grid_.steps());
    }
    return missing();
  }

  void tell(ProvedSteps& result, const State<Mpfr>& end) const {
    result.steps = grid_.steps();
    result.working_digits = digits10<Mpfr>();
    result.growth = growth();
    result.only_within = lower_text(in_mpfr(arb_midref(raw(course_.radius())), MPFR_RNDD));
    const DiscreteState state = course_.state();
    result.q = texts(state.q);
    result.p = texts(state.p);
    result.lambda = texts(course_.multipliers());
    result.off_q = distance_text(state.q, end.q);
    result.off_p = distance_text(state.p, end.p);
    result.q_radius = upper_text(q_.radius);
    result.p_radius = upper_text(p_.radius);
    result.e_H = upper_text(e_H_.most);
    result.e_H_least = lower_text(e_H_.least);
    if (course_.multipliers().empty()) return;
    for (const Constraint<Mpfr>& constraint : problem_.constraints) result.lambda_names.push_back(constraint.name);
    result.lambda_radius = upper_text(lambda_.radius);
    result.e_g = upper_text(e_g_.most);
    result.e_g_least = lower_text(e_g_.least);
  }

 private:
  void make_step(long n) {
    const std::string from = to_text(grid_.time(n - 1));
    try {
      course_.step();
    } catch (const CourseTooWide&) {
      throw;
    } catch (const StageFailure& failure) {
      throw StepError(n, from, failure);
    } catch (const IntegrationError& error) {
      throw IntegrationError(fmt::format("step {}, from t = {}, is not proved: {}", n, from, error.what()));
    }
  }

  void see() {
    const BallScope scope(significand_bits<Mpfr>());
    const DiscreteState state = course_.state();
    if (course_.steps() == 0) H0_ = state.H();
    q_.add(state.q);
    p_.add(state.p);
    lambda_.add(course_.multipliers());
    p_.raise_size(course_.momentum_size());
    lambda_.raise_size(course_.multiplier_size());
    const RealBall change = state.H() - H0_;
    e_H_.add(change);
    H_.add({state.kinetic, state.potential});
    Bounds of_change;
    of_change.add({change});
    raise_to(H_.radius, of_change.radius);
    for (const RealBall& g : state.g) e_g_.add(g);
  }

  double missing() const {
    double most = std::max(q_.missing(asked_.digits), p_.missing(asked_.digits));
    if (lambda_.size > 0) most = std::max(most, lambda_.missing(asked_.digits));
    return std::max(most, H_.missing(asked_.digits));
  }
  /// log10 of the bounds of the state.
  double width() const { return std::max(q_.missing(0), p_.missing(0)); }
  double growth() const { return width() - first_; }

  /// Decimals down to the digits that are asked for of the greatest, or to those that are known.
  std::vector<std::string> texts(const std::vector<RealBall>& x) const {
    using std::log10;
    const auto exponent = [](const Mpfr& of) { return std::lround(std::floor(approximately(Mpfr(log10(of))))); };
    Bounds bounds;
    bounds.add(x);
    if (bounds.size == 0) return std::vector<std::string>(x.size(), "0");
    long last = exponent(bounds.size) - asked_.digits + 1;
    if (bounds.radius > 0) last = std::max(last, exponent(Mpfr(2 * bounds.radius)) + 1);
    std::vector<std::string> result;
    for (const RealBall& component : x) {
      const Mpfr centre = in_mpfr(arb_midref(raw(component)), MPFR_RNDN);
      const long kept = centre == 0 ? 0 : exponent(magnitude(centre)) - last + 1;
      result.push_back(kept <= 0 ? "0" : rounded_text(to_text(centre), static_cast<int>(kept)));
    }
    return result;
  }
  /// What the numbers found are off by at most.
  static std::string distance_text(const std::vector<RealBall>& x, const Vector<Mpfr>& found) {
    const BallScope scope(significand_bits<Mpfr>());
    Magnitudes off;
    for (std::size_t i = 0; i < x.size(); ++i) off.add(x[i] - exact_ball(raw(found[static_cast<Index>(i)])));
    return upper_text(off.most);
  }

  const StepsToProve& asked_;
  const TimeGrid<Mpfr>& grid_;
  const Problem<Mpfr>& problem_;
  ProvedCourse course_;
  RealBall H0_;
  Bounds q_, p_, lambda_, H_;
  Magnitudes e_H_, e_g_;
  double first_ = 0;
};

/// With so many digits. \return those that are missing
double attempt(const StepsToProve& asked, const State<Mpfr>& end, unsigned digits, ProvedSteps& result) {
  const PrecisionScope scope(digits);
  const auto with_twice = [&](const auto& work) {
    const PrecisionScope twice(2 * digits + 20);
    return work();
  };
  Assembled<Mpfr> exact = assembled_for_proof(asked.scene);
  Assembled<Mpfr> rounded = assemble<Mpfr>(asked.scene);
  const TimeGrid<Mpfr> grid =
      with_twice([&] { return TimeGrid<Mpfr>(asked.step, asked.until, asked.scene.constants); });
  State<Mpfr> to = end;
  if (asked.direction == Direction::backward)
    for (Vector<Mpfr>* const p : {&exact.p0, &rounded.p0, &to.p}) *p = -*p;
  const HbvmMethod named(asked.method);
  const Hbvm<Mpfr> method = named.coefficients<Mpfr>(named.constraint_nodes(rounded.problem));
  Attempt made(asked, exact, rounded, method, grid);
  const double missing = made.run();
  if (missing <= 0) made.tell(result, to);
  return missing;
}

}  // namespace

ProvedSteps prove_steps(const StepsToProve& steps, const State<Mpfr>& end) {
  const double before = thread_seconds();
  constexpr int guard = 20, attempts = 8;
  constexpr double most = 20'000;
  ProvedSteps result;
  result.digits = steps.digits;
  double digits = steps.digits + guard;
  for (int made = 1;; ++made) {
    try {
      const double missing = attempt(steps, end, static_cast<unsigned>(digits), result);
      if (missing <= 0) break;
      digits += std::ceil(missing) + 3;
    } catch (const CourseTooWide& error) {
      if (made == attempts) throw;
      digits += std::ceil(digits / 2);
    }
    if (made == attempts || digits > most)
      throw IntegrationError(fmt::format("a proof of these steps takes more than {:.0f} digits: ask for fewer steps",
                                         std::min(digits, most)));
  }
  if (steps.direction == Direction::backward)
    for (std::string& p : result.p)
      if (p != "0") p = p.starts_with('-') ? p.substr(1) : "-" + p;
  result.cpu_seconds = thread_seconds() - before;
  return result;
}

}  // namespace hbvm::core

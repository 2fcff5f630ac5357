#include "run/periodic_orbit.hpp"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "integrate/observations.hpp"
#include "interruption.hpp"
#include "linear/norm.hpp"
#include "linear/product.hpp"
#include "linear/rounded.hpp"
#include "reference/hbvm_motion.hpp"
#include "reference/route_run.hpp"
#include "reference/taylor.hpp"
#include "reference/usual_step.hpp"
#include "scalar/literal.hpp"
#include "scalar/log2_of.hpp"
#include "scalar/text.hpp"

namespace hbvm::core {
namespace {

constexpr const char* unfinished = "the search for a periodic motion was interrupted";

/// A start and a period.
struct Closed {
  PhaseState start;
  Mpfr period;
};

Closed in_all_digits(const Closed& x) {
  return {{rounded<Mpfr>(x.start.q), rounded<Mpfr>(x.start.p)}, rounded_to<Mpfr>(raw(x.period))};
}

/// What is to be 0: the end less the start over the scales, the place along the motion, and H less that of the scene.
struct Defect {
  Vector<Mpfr> closing;
  Mpfr place, energy;
  double log10_size() const { return std::max({log10_of(max_norm(closing)), log10_of(place), log10_of(energy)}); }
};

/// The scene in the digits of the scope, which stays the same as long as this lives.
class ClosingEquations {
 public:
  explicit ClosingEquations(const PeriodicRequest& request)
      : scene_(assemble<Mpfr>(request.scene)),
        problem_(scene_.problem),
        point_(problem_),
        start_{scene_.q0, point_.tangential(scene_.q0, scene_.p0)},
        space_(problem_, start_),
        H_(point_.energy(start_.q, start_.p)),
        H_size_(point_.energy_size(start_.q, start_.p)),
        seen_(request.scene) {
    if (!problem_.is_conservative()) throw InputError("a periodic motion is looked for where forces have a potential");
    if (H_size_ == 0) H_size_ = 1;
    if (!request.plane) return;
    seen_.events.clear();
    seen_.observations = {{"plane", *request.plane, 0}};
    plane_.emplace(seen_, problem_);
  }

  const PhaseState& start() const { return start_; }
  TangentSpace& space() { return space_; }
  const Mpfr& H() const { return H_; }
  Mpfr energy(const PhaseState& x) { return point_.energy(x.q, x.p); }
  Mpfr energy_size(const PhaseState& x) { return point_.energy_size(x.q, x.p); }
  /// log10 of how far it is from the scene's start, over the scales.
  double moved_by(const Closed& x) { return log10_of(max_norm(space_.change(x.start, start_, Mpfr(1)))); }

  TaylorMotion motion_from(const PhaseState& x) const {
    return {problem_, x.q, x.p, [] { end_if_asked(unfinished); }};
  }
  PhaseState after(const PhaseState& x, const Mpfr& t) const {
    TaylorMotion motion = motion_from(x);
    motion.advance_to(t);
    return {motion.q(), motion.p()};
  }

  /// By HBVM, whose steps are chosen otherwise.
  PhaseState after_by_hbvm(const PhaseState& x, const Mpfr& t) {
    constexpr int few = 3;
    const double digits = digits10<Mpfr>() - few;
    const int s = stages_of_route(digits);
    const Hbvm<Mpfr> method = make_hbvm<Mpfr>(s, s);
    HbvmMotion motion(problem_, method, x.q, x.p, digits, t);
    motion.advance_to(t, [](const Mpfr&) { end_if_asked(unfinished); });
    return {motion.q(), point_.tangential(motion.q(), motion.p())};
  }

  /// Rates of change over the scales.
  Vector<Mpfr> flow(const PhaseState& x) {
    Vector<Mpfr> v(x.q.size());
    point_.set_velocity(x.q, x.p, v);
    const Vector<Mpfr> nothing = Vector<Mpfr>::Zero(v.size());
    return space_.change({v, point_.force(x.q, x.p)}, {nothing, nothing}, Mpfr(1));
  }

  Defect defect(const Closed& x, const PhaseState& end) {
    return {space_.change(end, x.start, Mpfr(1)), place(x.start), Mpfr((energy(x.start) - H_) / H_size_)};
  }

  /// The value of the plane, or how far x is before the scene's start along its motion.
  Mpfr place(const PhaseState& x) {
    if (plane_) return plane_->see(Mpfr(0), x.q, x.p)[0];
    if (along_.size() == 0) along_ = flow(start_);
    return dot(along_, space_.change(x, start_, Mpfr(1)));
  }

 private:
  Assembled<Mpfr> scene_;
  const Problem<Mpfr>& problem_;
  StateEvaluator<Mpfr> point_;
  PhaseState start_;
  TangentSpace space_;
  Mpfr H_, H_size_;
  Scene seen_;
  std::optional<Observations<Mpfr>> plane_;
  Vector<Mpfr> along_;
};

/// The derivative of the defect in few digits, and what Newton's method does with it.
class ClosingStep {
 public:
  /// \param end of the motion from x
  ClosingStep(ClosingEquations& equations, const Closed& x, const PhaseState& end) {
    // Half of the digits, so that the quotient has the other half.
    const Mpfr small = pow(Mpfr(10), -static_cast<int>(digits10<Mpfr>()) / 2);
    TangentSpace& space = equations.space();
    basis_ = space.basis(x.start, small);
    ends_ = Matrix<Mpfr>(basis_.rows(), basis_.cols());
    const Index m2 = basis_.rows(), n = basis_.cols();
    Eigen::MatrixXd derivative = Eigen::MatrixXd::Zero(m2 + 2, n + 1);
    const Defect here = equations.defect(x, end);
    for (Index j = 0; j < n; ++j) {
      const PhaseState moved = space.moved(x.start, small * basis_.col(j));
      const PhaseState moved_end = equations.after(moved, x.period);
      ends_.col(j) = space.change(moved_end, end, small);
      const Defect there = equations.defect({moved, x.period}, moved_end);
      for (Index i = 0; i < m2; ++i) derivative(i, j) = quotient(there.closing[i], here.closing[i], small);
      derivative(m2, j) = quotient(there.place, here.place, small);
      derivative(m2 + 1, j) = quotient(there.energy, here.energy, small);
    }
    const Vector<Mpfr> flow = equations.flow(end);
    for (Index i = 0; i < m2; ++i) derivative(i, n) = approximately(Mpfr(flow[i] * x.period));
    // Changes that nothing conserved allows are known to some eight digits.
    constexpr double lost = 1 / double{100'000'000};
    solver_.compute(derivative, Eigen::ComputeThinU | Eigen::ComputeThinV);
    solver_.setThreshold(lost);
  }

  /// Goes on by a part of Newton's step. \return log10 of the size of the whole step
  double move(ClosingEquations& equations, Closed& x, const Defect& defect, double part) const {
    const Index m2 = basis_.rows(), n = basis_.cols();
    // In units of its size: it may be beyond the range of double.
    Mpfr size = max_norm(defect.closing);
    raise_magnitude(size, defect.place);
    raise_magnitude(size, defect.energy);
    if (size == 0) return -HUGE_VAL;
    Eigen::VectorXd right(m2 + 2);
    for (Index i = 0; i < m2; ++i) right[i] = -approximately(Mpfr(defect.closing[i] / size));
    right[m2] = -approximately(Mpfr(defect.place / size));
    right[m2 + 1] = -approximately(Mpfr(defect.energy / size));
    const Eigen::VectorXd step = solver_.solve(right);
    Vector<Mpfr> change = Vector<Mpfr>::Zero(m2);
    for (Index j = 0; j < n; ++j)
      change += Mpfr(size * in_mpfr(step[j] * part)) * rounded<Mpfr>(Vector<Mpfr>(basis_.col(j)));
    x.start = equations.space().moved(x.start, change);
    x.period *= 1 + size * in_mpfr(step[n] * part);
    return log10_of(size) + std::log10(step.lpNorm<Eigen::Infinity>());
  }

  double log10_growth() const {
    return std::max(double{0}, std::log10(approximately(Mpfr(max_norm(Vector<Mpfr>(ends_.reshaped()))))));
  }
  std::vector<std::complex<double>> multipliers() const { return multipliers_of(basis_, ends_); }

 private:
  static Mpfr in_mpfr(double x) { return rounded_to<Mpfr>(raw(exactly(x))); }
  static double quotient(const Mpfr& there, const Mpfr& here, const Mpfr& small) {
    return approximately(Mpfr((there - here) / small));
  }

  Matrix<Mpfr> basis_, ends_;
  Eigen::JacobiSVD<Eigen::MatrixXd> solver_;
};

/// Times at which the motion comes back towards its start. Those that come as near as any, or nearly, are first, in the
/// order of time; the others follow, the nearest first.
std::vector<Mpfr> returns_of(ClosingEquations& equations, const Scene& scene, const Expression& until) {
  constexpr int parts = 4;
  const Mpfr end = evaluate<Mpfr>(until, scene.constants),
             step = evaluate<Mpfr>(usual_step(scene, until), scene.constants) / parts;
  const PhaseState& start = equations.start();
  const auto distance = [&](const PhaseState& x) {
    return approximately(norm(equations.space().change(x, start, Mpfr(1))));
  };
  struct Near {
    Mpfr t;
    double distance;
  };
  std::vector<Near> found;
  TaylorMotion motion = equations.motion_from(start);
  PhaseState last = start;
  double before = 0, here = 0, least = HUGE_VAL;
  Mpfr t = 0;
  while (t < end) {
    const Mpfr next = t + step < end ? Mpfr(t + step) : end;
    motion.advance_to(next);
    const PhaseState state{motion.q(), motion.p()};
    const double there = distance(state);
    if (here < before && here <= there) {
      // The distance across the flow, where that is least.
      const Vector<Mpfr> off = equations.space().change(last, start, Mpfr(1)), flow = equations.flow(last);
      const Mpfr ahead = dot(off, flow) / dot(flow, flow);
      found.push_back({Mpfr(t - ahead), approximately(norm(Vector<Mpfr>(off - ahead * flow)))});
      least = std::min(least, found.back().distance);
    }
    before = here;
    here = there;
    last = state;
    t = next;
  }
  if (found.empty())
    throw IntegrationError("the motion does not come back towards its start until t = " + until.text());
  constexpr double thousandth = 1 / double{1000};
  const double near = std::max(2 * least, thousandth);
  const auto others =
      std::stable_partition(found.begin(), found.end(), [&](const Near& x) { return x.distance <= near; });
  std::sort(others, found.end(), [](const Near& a, const Near& b) { return a.distance < b.distance; });
  constexpr std::size_t most = 6;
  std::vector<Mpfr> times;
  for (const Near& x : found)
    if (times.size() < most) times.push_back(x.t);
  return times;
}

constexpr int most_iterations = 60;

/// Moves the period alone to where the end is nearest to the start: of a start that is periodic already, nothing else
/// need be moved. \return the end
PhaseState settle_period(ClosingEquations& equations, Closed& x) {
  constexpr int rounds = 5;
  PhaseState end = equations.after(x.start, x.period);
  for (int n = 0; n < rounds; ++n) {
    const Vector<Mpfr> off = equations.space().change(end, x.start, Mpfr(1)), flow = equations.flow(end);
    const Mpfr ahead = dot(off, flow) / dot(flow, flow);
    if (!(ahead < x.period)) break;
    x.period -= ahead;
    end = equations.after(x.start, x.period);
  }
  return end;
}

/// A motion that closes to most of the digits of the scope, from the scene's start and a time near its period.
/// \param iterations is counted \throws IntegrationError if there is none nearby
Closed closed_near(ClosingEquations& equations, const Mpfr& t, int& iterations,
                   const std::function<void(double)>& progress) {
  constexpr int halvings = 6;
  const int all = static_cast<int>(digits10<Mpfr>()), round_off = all - 6, near_digits = all / 2 + 2;
  Closed x{equations.start(), t};
  PhaseState end = settle_period(equations, x);
  Defect defect = equations.defect(x, end);
  double moved = defect.log10_size() < -round_off ? -HUGE_VAL : 0;
  for (int count = 0; moved > -near_digits; ++count, ++iterations) {
    progress(static_cast<double>(count) / most_iterations);
    const ClosingStep step(equations, x, end);
    const double size = defect.log10_size();
    bool nearer = false;
    for (int n = 0; n <= halvings && count < most_iterations && !nearer; ++n) try {
        Closed tried = x;
        moved = step.move(equations, tried, defect, std::ldexp(double{1}, -n));
        if (!(tried.period > 0)) continue;
        PhaseState tried_end = equations.after(tried.start, tried.period);
        Defect found = equations.defect(tried, tried_end);
        nearer = found.log10_size() < size || moved < -near_digits || found.log10_size() < -round_off;
        if (!nearer) continue;
        x = std::move(tried);
        end = std::move(tried_end);
        defect = std::move(found);
      } catch (const Interrupted&) {
        throw;
      } catch (const Error&) {  // there is no such state, or no motion from it
      }
    if (!nearer)
      throw IntegrationError(fmt::format(
          "no periodic motion is found near the start: the nearest comes back to 10^{:.1f} of the sizes of q and p, at "
          "t = {}",
          size, to_scientific(x.period, 6)));
  }
  return x;
}

}  // namespace

PeriodicOrbit periodic_orbit(const PeriodicRequest& request) {
  constexpr unsigned few_digits = 36;
  constexpr int guard = 12, round_off = few_digits - 4;
  int iterations = 0;
  const auto progress = [&](double part) {
    if (request.progress) request.progress(part);
    end_if_asked(unfinished);
  };
  const PrecisionScope few(few_digits);
  ClosingEquations near(request);
  std::optional<Closed> first;
  std::exception_ptr failure;
  for (const Mpfr& t : returns_of(near, request.scene, request.until)) try {
      first.emplace(closed_near(near, t, iterations, [&](double part) { progress(part / 2); }));
      break;
    } catch (const IntegrationError&) {
      if (!failure) failure = std::current_exception();
    }
  if (!first) std::rethrow_exception(failure);
  const ClosingStep step(near, *first, near.after(first->start, first->period));
  const auto working = static_cast<unsigned>(request.digits + guard + std::ceil(step.log10_growth()));
  const PrecisionScope all(working);
  ClosingEquations equations(request);
  // Made anew: a number that is there keeps its digits.
  Closed x = in_all_digits(*first);
  if (equations.moved_by(*first) < -round_off) {
    x.start = equations.start();
    settle_period(equations, x);
  }
  const double enough = -(request.digits + 4);
  double last = 0;
  for (int n = 0;; ++n) {
    progress((1 + static_cast<double>(n) / most_iterations) / 2);
    ++iterations;
    const double now = step.move(equations, x, equations.defect(x, equations.after(x.start, x.period)), 1);
    if (now < enough) break;
    if (n == most_iterations || (n > 2 && now > last))
      throw IntegrationError(
          fmt::format("the periodic motion is found to {:.0f} digits, and not to {}", -now, request.digits));
    last = now;
  }
  Closed other = x;
  const double apart = step.move(equations, other, equations.defect(x, equations.after_by_hbvm(x.start, x.period)), 1);
  const long agreed = std::min(static_cast<long>(working), static_cast<long>(-apart));
  if (agreed <= request.digits)
    throw IntegrationError(
        fmt::format("the routes agree in {} digits of the periodic motion, not in {}; nothing is given out", agreed,
                    request.digits));
  progress(1);
  // What vanishes is measured by what it is at other times.
  Mpfr H_size = equations.energy_size(x.start);
  raise_to(H_size, equations.energy_size(equations.after(x.start, Mpfr(x.period / 4))));
  const TangentSpace& space = equations.space();
  return {.start = x.start,
          .period = x.period,
          .H = equations.energy(x.start),
          .q_size = space.q_scale(),
          .p_size = space.p_scale(),
          .H_size = H_size,
          .agreed = agreed,
          .iterations = iterations,
          .multipliers = step.multipliers()};
}

}  // namespace hbvm::core

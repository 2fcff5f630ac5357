#include "round_off_growth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "hard_cases/line_fit.hpp"
#include "integrate/integrate.hpp"
#include "measure.hpp"
#include "problem/state_evaluator.hpp"
#include "run/round_off.hpp"
#include "scalar/with_scalar.hpp"
#include "scene/assemble.hpp"
#include "step/hbvm_stepper.hpp"

namespace hbvm::core {

void Straying::add(double value) {
  if (n_ == 0) {
    start_.fill(value);
  } else {
    for (std::size_t j = 0; j < most; ++j) greatest_[j] = std::max(greatest_[j], std::abs(value - start_[j]));
    const auto ends = static_cast<std::size_t>(std::countr_zero(static_cast<unsigned long>(n_)));
    for (std::size_t j = 0; j <= std::min(ends, most - 1); ++j) {
      sum_[j] += greatest_[j];
      ++count_[j];
      start_[j] = value;
      greatest_[j] = 0;
    }
  }
  ++n_;
}

std::vector<Straying::Point> Straying::points() const {
  std::vector<Point> result;
  for (std::size_t j = 0; j < most && count_[j] > 0; ++j)
    result.push_back({1L << j, sum_[j] / static_cast<double>(count_[j])});
  return result;
}

namespace {

/// H and g at every mesh point; the sizes of their terms, and what a step adds to them, at some.
template <Scalar S>
class Walker final : public Observer<S> {
 public:
  Walker(const Problem<S>& problem, long steps)
      : problem_(problem),
        point_(problem),
        gradient_(problem, 1),
        stride_(std::max(1L, steps / 1024)),
        v_(problem.m()),
        g_(static_cast<std::size_t>(problem.nu())),
        g_size_(g_.size(), 0),
        g_turnover_(g_.size(), 0),
        g_greatest_(g_.size(), 0) {}

  void observe(const Snapshot<S>& snapshot) override {
    const S energy = point_.energy(snapshot.q, snapshot.p);
    if (snapshot.n == 0) H0_ = energy;
    const double H = in_units(S(energy - H0_));
    H_.add(H);
    raise_to(H_greatest_, std::abs(H));
    const Vector<S>& g = point_.constraints(snapshot.q);
    for (std::size_t a = 0; a < g_.size(); ++a) {
      const double value = in_units(g[static_cast<Index>(a)]);
      g_[a].add(value);
      raise_to(g_greatest_[a], std::abs(value));
    }
    if (snapshot.n % stride_ == 1 || stride_ == 1) measure(snapshot);
    if (snapshot.n % stride_ == 0) {
      q_ = snapshot.q;
      p_ = snapshot.p;
    }
  }

  RoundOffGrowth walk() const {
    RoundOffGrowth walk;
    walk.H = H_.points();
    for (Straying::Point& point : walk.H) point.distance /= H_size_;
    walk.e_H = H_greatest_ / H_size_;
    walk.turnover_H = H_turnover_ / H_size_;
    std::size_t worst = 0;
    for (std::size_t a = 0; a < g_.size(); ++a) {
      raise_to(walk.turnover_g, g_turnover_[a] / g_size_[a]);
      if (g_greatest_[a] / g_size_[a] >= g_greatest_[worst] / g_size_[worst]) worst = a;
    }
    if (g_.empty()) return walk;
    walk.e_g = g_greatest_[worst] / g_size_[worst];
    walk.g = g_[worst].points();
    for (Straying::Point& point : walk.g) point.distance /= g_size_[worst];
    return walk;
  }

 private:
  static double in_units(const S& x) { return approximately(S(x / epsilon<S>())); }

  /// Sizes, and the step from the state that was kept.
  void measure(const Snapshot<S>& snapshot) {
    raise_to(H_size_, approximately(point_.energy_size(snapshot.q, snapshot.p)));
    if (snapshot.n == 0) return;
    problem_.mass.velocity(lanes(snapshot.p), lanes(v_));
    S sum = 0;
    for (Index i = 0; i < v_.size(); ++i) sum += magnitude(S(v_[i] * (snapshot.p[i] - p_[i])));
    raise_to(H_turnover_, approximately(sum));
    gradient_.update(lanes(snapshot.q));
    for (std::size_t a = 0; a < g_.size(); ++a) {
      const auto& pattern = gradient_.pattern(static_cast<Index>(a));
      sum = 0;
      for (std::size_t c = 0; c < pattern.coordinates.size(); ++c) {
        const Index i = pattern.coordinates[c];
        sum += magnitude(S(gradient_.values()(0, pattern.first + static_cast<Index>(c)) * (snapshot.q[i] - q_[i])));
      }
      raise_to(g_turnover_[a], approximately(sum));
      raise_to(g_size_[a], approximately(value(problem_.constraints[a], problem_.dimension, snapshot.q).size));
    }
  }

  const Problem<S>& problem_;
  StateEvaluator<S> point_;
  ConstraintGradient<S> gradient_;
  long stride_;
  Vector<S> v_, q_, p_;
  S H0_ = 0;
  Straying H_;
  double H_size_ = 0, H_turnover_ = 0, H_greatest_ = 0;
  std::vector<Straying> g_;
  std::vector<double> g_size_, g_turnover_, g_greatest_;
};

template <Scalar S>
RoundOffGrowth walk_in(const RunRequest& request) {
  const TimeGrid<S> grid(request.step, request.until, request.scene.constants);
  const Assembled<S> scene = assemble<S>(request.scene);
  const std::unique_ptr<Stepper<S>> stepper = request.method->make_stepper(scene.problem, request.solver);
  State<S> state(scene.q0, scene.p0);
  Walker<S> walker(scene.problem, grid.steps());
  integrate<S>(*stepper, state, grid, {&walker});
  RoundOffGrowth walk = walker.walk();
  walk.steps = grid.steps();
  return walk;
}

/// The exponent over the ten last doublings.
LineFit exponent_of(const std::vector<Straying::Point>& points) {
  constexpr std::size_t doublings = 10;
  std::vector<double> x, y;
  for (std::size_t i = points.size() > doublings ? points.size() - doublings - 1 : 0; i < points.size(); ++i) {
    if (!(points[i].distance > 0)) continue;
    x.push_back(std::log2(static_cast<double>(points[i].steps)));
    y.push_back(std::log2(points[i].distance));
  }
  return x.size() < 3 ? LineFit{} : fit_line(x, y);
}

void add_criteria(CaseResult& result, const std::string& name, const std::vector<Straying::Point>& points,
                  double greatest, double turnover, long steps) {
  constexpr double most = 6 / double{10};
  const LineFit fit = exponent_of(points);
  result.criteria.push_back({"exponent of " + name, fit.slope, most});
  result.criteria.push_back({name + ", units of round-off", greatest,
                             round_off_units(0) + 4 * std::sqrt(static_cast<double>(steps)) * turnover});
  result.message += fmt::format("{}{} ~ n^({:.3f} +- {:.3f}), {:.3g} units", result.message.empty() ? "" : "; ", name,
                                fit.slope, 2 * fit.standard_error, greatest);
}

}  // namespace

RoundOffGrowth round_off_growth_of(const RunRequest& request) {
  return with_scalar(request.precision, [&]<Scalar S>() { return walk_in<S>(request); });
}

CaseResult long_run(const RunRequest& request) {
  return guarded([&] {
    const RoundOffGrowth walk = round_off_growth_of(request);
    CaseResult result;
    add_criteria(result, "e_H", walk.H, walk.e_H, walk.turnover_H, walk.steps);
    if (!walk.g.empty()) add_criteria(result, "e_g", walk.g, walk.e_g, walk.turnover_g, walk.steps);
    return result;
  });
}

}  // namespace hbvm::core

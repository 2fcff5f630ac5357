#include "cost/energy_cost.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "integrate/energy_scale.hpp"
#include "integrate/integrate.hpp"
#include "interruption.hpp"
#include "long_work/json.hpp"
#include "run/run_stepper.hpp"
#include "scalar/with_scalar.hpp"
#include "step/hbvm_method.hpp"

namespace hbvm::core {
namespace {

const char* const cost_to_equal = "hbvm:2,2";

/// The greatest error of H so far, at times that are a quarter of an octave apart.
template <Scalar S>
class EnergyGrowth final : public Observer<S> {
 public:
  explicit EnergyGrowth(const Problem<S>& problem) : terms_(problem) {}

  void observe(const Snapshot<S>& snapshot) override {
    terms_.evaluate_energy(snapshot.q, snapshot.p);
    if (snapshot.n == 0) H_0_ = terms_.H();
    // What is no number stays: no comparison finds it.
    raise_to(error_, magnitude(S(terms_.H() - H_0_)));
    if (snapshot.n == 0) return;
    const double log2_t = std::log2(static_cast<double>(snapshot.n));
    constexpr int parts = 4;
    if (!marks_.empty() && log2_t < next_) return;
    next_ = (std::floor(log2_t * parts) + 1) / parts;
    marks_.push_back({snapshot.t, error_});
  }
  /// \param scale of H
  std::vector<PlotPoint> growth(const S& last, const S& scale) const {
    std::vector<PlotPoint> points;
    const auto add = [&](const S& t, const S& error) {
      points.push_back({log10_of(t), error == 0 ? log10_of(S(epsilon<S>())) : log10_of(S(error / scale))});
    };
    for (const auto& [t, error] : marks_) add(t, error);
    add(last, error_);
    return points;
  }

 private:
  static double log10_of(const S& x) {
    using std::log10;
    return approximately(S(log10(x)));
  }
  EnergyTerms<S> terms_;
  S H_0_ = 0, error_ = 0;
  double next_ = 0;
  std::vector<std::pair<S, S>> marks_;
};

template <Scalar S>
EnergyCost energy_run(const Scene& scene, const Expression& until, const CostCell& cell) {
  EnergyCost result{cell, cell.method->text()};
  const Assembled<S> assembled = assemble<S>(scene);
  const TimeGrid<S> grid(Expression::parse(step_text(until, cell.steps)), until, scene.constants);
  const auto run = [&](const std::vector<Observer<S>*>& observers) {
    RunStepper<S> stepper(assembled, cell.method, grid.step(), SolverKind::automatic, OnFailure::stop);
    result.method = stepper.method()->text();
    State<S> state(assembled.q0, assembled.p0);
    return integrate<S>(stepper, state, grid, observers).cpu_seconds;
  };
  try {
    EnergyGrowth<S> growth(assembled.problem);
    EnergyScale<S> scale(assembled.problem);
    std::vector<double> seconds{run({&growth, &scale})};
    constexpr double enough = double{1} / 10;
    constexpr std::size_t least = 2, most = 400;
    for (double sum = 0; seconds.size() < most && (seconds.size() < least || sum < enough); sum += seconds.back())
      seconds.push_back(run({}));
    // What else the machine does makes a run longer, never shorter.
    result.seconds = *std::min_element(seconds.begin(), seconds.end());
    result.growth = growth.growth(grid.until(), scale.size());
    using std::log10;
    result.log10_round_off = approximately(S(log10(S(scale.round_off(cell.steps) / scale.size()))));
    for (const PlotPoint& point : result.growth)
      if (!std::isfinite(point[1])) result.failure = "the energy is not finite";
  } catch (const InputError&) {
    throw;
  } catch (const Interrupted&) {
    throw;
  } catch (const Error& error) {
    result.failure = error.what();
  }
  return result;
}

}  // namespace

Expression energy_until(const CostStudy& study, const MotionNature& nature) {
  const double seconds =
      counted_seconds(study, hbvm_of({2, 2}), Precision::parse("double"), nature) * usual_steps(study, nature);
  int times = 1000;
  while (times > 10 && !(seconds * times <= study.most_seconds)) times /= 10;
  return Expression::parse(times_text(study.until, times));
}

std::vector<CostCell> energy_cells(const CostStudy& study, const MotionNature& nature) {
  const Precision precision = Precision::parse("double");
  const double budget = counted_seconds(study, hbvm_of({2, 2}), precision, nature);
  const double times = static_cast<double>(times_of(energy_until(study, nature), study));
  std::map<std::string, MethodPtr> members;
  const auto far = [](const Method& method) { return std::abs(method.order() - 4); };
  std::vector<std::string> order;
  for (const MethodPtr& method : study.methods) {
    if (method->order() <= 0 || method->digits()) continue;
    const std::string family = family_of(*method);
    const auto [place, is_new] = members.try_emplace(family, method);
    if (is_new) order.push_back(family);
    if (far(*method) < far(*place->second)) place->second = method;
  }
  std::vector<CostCell> cells;
  for (const std::string& family : order) {
    const MethodPtr& method = members.at(family);
    const double steps =
        times * usual_steps(study, nature) * budget / counted_seconds(study, method, precision, nature);
    if (!std::isfinite(steps)) continue;
    // Numbers of steps that are powers of the root of 2.
    const long middle = std::lround(2 * std::log2(std::max(steps, double{4})));
    for (const long rung : {-2, -1, 0, 1, 2})
      cells.push_back({method, precision, std::lround(std::exp2(static_cast<double>(middle + rung) / 2))});
  }
  return cells;
}

std::vector<CostCell> conserving_cells(const CostStudy& study, const MotionNature& nature) {
  const auto is_hbvm = [](const MethodPtr& method) { return as_hbvm(*method) != nullptr; };
  std::vector<CostCell> cells;
  if (std::none_of(study.methods.begin(), study.methods.end(), is_hbvm)) return cells;
  const long steps = std::max(1L, std::lround(usual_steps(study, nature)));
  for (const char* const precision : {"double", "mpfr:40"})
    for (const int s : {1, 2, 3, 4}) {
      int last = 0;
      for (const int k : {s, s + 1, 2 * s, 3 * s, 4 * s, 6 * s}) {
        if (k > last) cells.push_back({hbvm_of({k, s}), Precision::parse(precision), steps});
        last = std::max(last, k);
      }
    }
  return cells;
}

std::string measure_energy(const Scene& scene, const Expression& until, const CostCell& cell) {
  const EnergyCost cost = with_scalar(cell.precision, [&]<Scalar S>() { return energy_run<S>(scene, until, cell); });
  if (!cost.failure.empty()) return dumped({{"failure", cost.failure}}, -1);
  OrderedJson growth = OrderedJson::array();
  for (const PlotPoint& point : cost.growth) growth.push_back({point[0], point[1]});
  return dumped({{"failure", ""},
                 {"method", cost.method},
                 {"seconds", cost.seconds},
                 {"log10_round_off", cost.log10_round_off},
                 {"growth", growth}},
                -1);
}

EnergyCost read_energy_cost(const CostCell& cell, const std::string& text) {
  return read_json(text, "a run of known energy", [&](const OrderedJson& json) {
    EnergyCost cost{cell, cell.method->text(), json.at("failure")};
    if (!cost.failure.empty()) return cost;
    cost.method = json.at("method");
    cost.seconds = json.at("seconds");
    cost.log10_round_off = json.at("log10_round_off");
    for (const OrderedJson& point : json.at("growth")) cost.growth.push_back({point.at(0), point.at(1)});
    return cost;
  });
}

std::vector<const EnergyCost*> at_equal_cost(const std::vector<EnergyCost>& runs) {
  std::vector<std::vector<const EnergyCost*>> methods;
  for (const EnergyCost& run : runs) {
    if (!run.failure.empty() || !(run.seconds > 0)) continue;
    if (methods.empty() || methods.back().front()->cell.method->key() != run.cell.method->key()) methods.emplace_back();
    methods.back().push_back(&run);
  }
  if (methods.empty()) return {};
  const auto equal = std::find_if(methods.begin(), methods.end(), [](const auto& group) {
    return group.front()->cell.method->text() == cost_to_equal;
  });
  const auto& given = equal == methods.end() ? methods.front() : *equal;
  const double wanted = std::log(given[given.size() / 2]->seconds);
  std::vector<const EnergyCost*> result;
  for (const auto& group : methods)
    result.push_back(*std::min_element(group.begin(), group.end(), [&](const EnergyCost* a, const EnergyCost* b) {
      return std::abs(std::log(a->seconds) - wanted) < std::abs(std::log(b->seconds) - wanted);
    }));
  return result;
}

}  // namespace hbvm::core

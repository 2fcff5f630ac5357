#include "groups.hpp"

#include <cmath>

#include "chain.hpp"
#include "problem/state_evaluator.hpp"
#include "raw_cost.hpp"
#include "write_file.hpp"

namespace hbvm::core::speed {
namespace {

constexpr const char* satellites = "tethered_satellites";

std::string microseconds(double seconds) {
  return seconds < 1e-3 ? fmt::format("{:.3g} us", seconds * 1e6) : fmt::format("{:.3g} ms", seconds * 1e3);
}

/// What both took.
std::string costs_text(const StepCost& a, const StepCost& b) {
  return fmt::format("{} and {} a step, {:.1f} and {:.1f} sweeps", microseconds(a.seconds), microseconds(b.seconds),
                     a.sweeps, b.sweeps);
}

std::string method_text(int k, int s) { return fmt::format("HBVM({},{})", k, s); }

/// The paper's iteration against the default solver.
template <Scalar S>
Row against_papers(const std::string& scene_name, int k, int s, const std::string& precision, double limit, long steps,
                   long paper_steps) {
  const Assembled<S> scene = assemble<S>(load_scene(scene_name));
  const S h = S(1) / S(10);
  const StepCost own = step_cost<S>(scene, k, s, h, SolverKind::newton, steps),
                 papers = step_cost<S>(scene, k, s, h, SolverKind::paper, paper_steps);
  return {fmt::format("{} {}, {}", scene_name, method_text(k, s), precision),
          "newton: times faster than paper",
          papers.seconds / own.seconds,
          limit,
          true,
          costs_text(own, papers)};
}

/// The default solvers of quad and of double, at the same step of 1 / `per_unit`.
Row quad_over_double(const std::string& scene_name, int k, int s, int per_unit, double limit) {
  constexpr long steps = 400;
  const Scene scene = load_scene(scene_name);
  const StepCost quad = step_cost<Quad>(assemble<Quad>(scene), k, s, Quad(Quad(1) / per_unit), SolverKind::automatic,
                                        steps),
                 in_double =
                     step_cost<double>(assemble<double>(scene), k, s, 1.0 / per_unit, SolverKind::automatic, steps);
  return {fmt::format("{} {}, h = 1/{}, quad", scene_name, method_text(k, s), per_unit),
          "double",
          quad.seconds / in_double.seconds,
          limit,
          false,
          costs_text(quad, in_double)};
}

}  // namespace

std::vector<Group> groups() {
  return {{"double", "Satellites in double, h = 0.1, against RATTLE at h = 0.1", double_rows},
          {"best", "Satellites to T = 1000 in double, errors of q and p at t = 100 below 1e-9", best_rows},
          {"quad", "Quad against the paper's iteration with h = 0.1, and against double", quad_rows},
          {"mpfr", "Satellites in more digits, h = 0.1", mpfr_rows},
          {"raw", "Residuals and sweeps against the raw cost of their operations", raw_rows},
          {"nodes", "Gauss-Legendre nodes and weights against Arb", node_rows},
          {"chain", "Chain of rods, h = 0.01: slope of time per step", chain_rows},
          {"scenes", "Other scenes", scene_rows}};
}

std::vector<Row> double_rows() {
  const Assembled<double> scene = assemble<double>(load_scene(satellites));
  const double h = 1.0 / 10;
  std::vector<Row> rows;
  constexpr long steps = 10'000;
  rattle_cost<double>(scene, h, steps);  // the first run in a process is slower
  for (const auto& [k, s, limit] : {std::tuple(1, 1, 2.0), {5, 1, 4.5}, {3, 3, 9.0}, {5, 3, 10.0}}) {
    const StepCost rattle = rattle_cost<double>(scene, h, steps),
                   own = step_cost<double>(scene, k, s, h, SolverKind::automatic, steps);
    rows.push_back({method_text(k, s) + ", auto", "RATTLE", own.seconds / rattle.seconds, limit, false,
                    fmt::format("{} and {} a step, {:.2f} sweeps and {:.2f} iterations", microseconds(own.seconds),
                                microseconds(rattle.seconds), own.sweeps, rattle.sweeps)});
  }
  return rows;
}

namespace {

/// q and the output momentum at time t.
template <Scalar S>
std::pair<Vector<S>, Vector<S>> output_at(const Scene& text, int k, int s, const S& h, long steps) {
  const Assembled<S> scene = assemble<S>(text);
  const Hbvm<S> method = make_hbvm<S>(k, s);
  HbvmStepper<S> stepper(scene.problem, method, SolverKind::automatic);
  State<S> state(scene.q0, scene.p0);
  for (long i = 0; i < steps; ++i) stepper.step(state, h);
  StateEvaluator<S> point(scene.problem);
  return {state.q, point.tangential(state.q, state.p)};
}

}  // namespace

std::vector<Row> best_rows() {
  const Scene text = load_scene(satellites);
  const Assembled<double> scene = assemble<double>(text);
  constexpr double T = 1000, t = 100, wanted = 1e-9;
  Vector<double> q_true, p_true;
  {
    const PrecisionScope digits(34);
    const auto [q, p] = output_at<Mpfr>(text, 22, 16, Mpfr(1) / 5, 500);
    q_true.resize(q.size());
    p_true.resize(p.size());
    for (Index j = 0; j < q.size(); ++j) {
      q_true[j] = approximately(q[j]);
      p_true[j] = approximately(p[j]);
    }
  }
  const double rattle = rattle_cost<double>(scene, 1.0 / 10, 10'000).seconds * 10'000;
  Row best{"", "RATTLE, h = 0.1", 1e9, 12, false, ""};
  for (const auto& [k, s] : {std::pair(6, 4), {8, 5}, {9, 6}, {11, 7}, {12, 8}, {14, 10}, {16, 12}}) {
    for (const int steps_a_unit : {1, 2, 3, 4, 5, 8, 10}) {
      const double h = 1.0 / steps_a_unit;
      try {
        const auto [q, p] = output_at<double>(text, k, s, h, static_cast<long>(t) * steps_a_unit);
        const double error = std::max(max_norm(Vector<double>(q - q_true)), max_norm(Vector<double>(p - p_true)));
        if (!(error < wanted)) continue;
        const StepCost cost =
            step_cost<double>(scene, k, s, h, SolverKind::automatic, static_cast<long>(T) * steps_a_unit / 10);
        const double ratio = cost.seconds * T * steps_a_unit / rattle;
        if (ratio < best.ratio) {
          best.ratio = ratio;
          best.work = fmt::format("{}, h = 1/{}, auto", method_text(k, s), steps_a_unit);
          best.detail = fmt::format("error {:.1e} at t = 100, {} a step, {:.2f} sweeps", error,
                                    microseconds(cost.seconds), cost.sweeps);
        }
        break;  // smaller steps cost more
      } catch (const StageFailure&) {
        // too large a step
      }
    }
  }
  return {best};
}

std::vector<Row> quad_rows() {
  return {against_papers<Quad>(satellites, 5, 3, "quad", 4, 100, 20),
          against_papers<Quad>(satellites, 16, 12, "quad", 4, 20, 4),
          quad_over_double(satellites, 5, 3, 10, 10),
          quad_over_double(satellites, 12, 8, 10, 8),
          quad_over_double("double_pendulum", 6, 6, 10, 6),
          quad_over_double("heavy_top", 4, 4, 10, 5)};
}

std::vector<Row> mpfr_rows() {
  std::vector<Row> rows;
  for (const auto& [digits, k, s, limit, steps, paper_steps] : {std::tuple(50U, 16, 12, 10.0, 40L, 3L),
                                                                {100U, 6, 4, 15.0, 100L, 10L},
                                                                {100U, 16, 12, 20.0, 40L, 2L},
                                                                {100U, 24, 20, 20.0, 20L, 1L},
                                                                {1000U, 16, 12, 30.0, 3L, 1L}}) {
    const PrecisionScope scope(digits);
    rows.push_back(against_papers<Mpfr>(satellites, k, s, fmt::format("mpfr:{}", digits), limit, steps, paper_steps));
  }
  return rows;
}

std::vector<Row> raw_rows() {
  std::vector<Row> rows;
  for (const unsigned digits : {100U, 1000U}) {
    const PrecisionScope scope(digits);
    const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene(satellites));
    const RawCost raw_cost;
    for (const auto& [k, s] : {std::pair(6, 4), {16, 12}}) {
      const Hbvm<Mpfr> method = make_hbvm<Mpfr>(k, s);
      for (const bool residual : {true, false}) {
        StageEquations<Mpfr> equations(scene.problem, method);
        StageUnknowns<Mpfr> x = equations.make_unknowns();
        StageResidual<Mpfr> r{x.gamma, x.lambda};
        // Numbers with all their digits, so that no operation is cheaper than it will be.
        for (Index j = 0; j < x.gamma.size(); ++j) x.gamma.data()[j] = sqrt(Mpfr(j + 2)) / 8;
        for (Index j = 0; j < x.lambda.size(); ++j) x.lambda.data()[j] = sqrt(Mpfr(j + 3)) / 8;
        Vector<Mpfr> q0 = scene.q0, p0 = scene.p0;
        for (Index j = 0; j < q0.size(); ++j) {
          q0[j] += sqrt(Mpfr(j + 2)) / 1000;
          p0[j] += sqrt(Mpfr(j + 5)) / 1000;
        }
        Matrix<Mpfr> gamma = x.gamma;
        equations.start({q0, p0, Mpfr(1) / 10});
        const double seconds = seconds_of([&] {
          if (residual) {
            equations.residual(x, r);
          } else {
            equations.move(x.gamma);
            equations.forces(x.psi);
            if (!equations.multipliers(x.psi, x.lambda, x.zeta)) throw Error("(29) is singular");
            equations.momenta(x.psi, x.zeta, gamma);
          }
        });
        OperationCounts counts;
        std::uint64_t calls = 0;
        for (const PartCount& part : equations.part_counts()) {
          counts += part.calls > 0 ? part.per_call : OperationCounts();
          calls = std::max(calls, part.calls);
        }
        for (const EffectCount& effect : equations.effect_counts())
          counts += static_cast<std::uint64_t>(k) * effect.per_evaluation;
        rows.push_back(
            {fmt::format("{}, mpfr:{}, {}", method_text(k, s), digits, residual ? "residual" : "sweep"),
             "its operations, raw", seconds / raw_cost.of(counts), 1.2, false,
             fmt::format(
                 "{}, {} operations; mul {:.0f} ns, add {:.0f} ns, div {:.0f} ns, sqrt {:.0f} ns, sin {:.0f} ns",
                 microseconds(seconds), counts.total(), raw_cost.multiply() * 1e9, raw_cost.add() * 1e9,
                 raw_cost.divide() * 1e9, raw_cost.sqrt_cost() * 1e9, raw_cost.sin() * 1e9)});
      }
    }
  }
  return rows;
}

namespace {

template <Scalar S>
std::vector<std::pair<double, double>> chain_times(std::vector<Row>& rows, const std::string& precision, long steps) {
  std::vector<std::pair<double, double>> times;
  std::string detail;
  for (const int n : {10, 50, 200}) {
    const Assembled<S> scene = assemble<S>(chain(n));
    const StepCost cost = step_cost<S>(scene, 4, 2, S(1) / S(100), SolverKind::newton, steps);
    times.emplace_back(n, cost.seconds);
    detail += fmt::format("{}{} rods {}, {:.1f} sweeps", detail.empty() ? "" : "; ", n, microseconds(cost.seconds),
                          cost.sweeps);
  }
  const double slope =
      std::log(times.back().second / times.front().second) / std::log(times.back().first / times.front().first);
  rows.push_back({"HBVM(4,2), newton, " + precision, "rods, 10 to 200", slope, 1.2, false, detail});
  return times;
}

}  // namespace

std::vector<Row> chain_rows() {
  std::vector<Row> rows;
  chain_times<double>(rows, "double", 100);
  const PrecisionScope scope(50);
  chain_times<Mpfr>(rows, "mpfr:50", 20);
  return rows;
}

std::vector<Row> scene_rows() {
  std::vector<Row> rows;
  for (const char* name : {"double_pendulum", "heavy_top"}) {
    const Assembled<double> scene = assemble<double>(load_scene(name));
    const double h = 1.0 / 100;
    const StepCost rattle = rattle_cost<double>(scene, h, 5000);
    for (const auto& [k, s] : {std::pair(1, 1), {3, 3}, {5, 3}}) {
      const StepCost own = step_cost<double>(scene, k, s, h, SolverKind::automatic, 5000);
      rows.push_back({fmt::format("{} {}, double, h = 0.01", name, method_text(k, s)), "RATTLE",
                      own.seconds / rattle.seconds, 0, false,
                      fmt::format("{} a step, {:.2f} sweeps", microseconds(own.seconds), own.sweeps)});
    }
    const PrecisionScope scope(100);
    rows.push_back(against_papers<Mpfr>(name, 6, 4, "mpfr:100", 0, 100, 10));
    rows.push_back(against_papers<Mpfr>(name, 16, 12, "mpfr:100", 0, 20, 2));
  }
  return rows;
}

namespace {

/// A curve of (x, seconds), and its numbers in a file.
Curve curve_of(const std::filesystem::path& file, const std::vector<std::pair<double, double>>& points,
               const std::string& label) {
  std::string text = "log10 x,log10 milliseconds a step\n";
  Curve curve{label, {}, true};
  for (const auto& [x, seconds] : points) {
    curve.points.push_back({std::log10(x), std::log10(seconds * 1000)});
    text += fmt::format("{:.6g},{:.6g}\n", curve.points.back()[0], curve.points.back()[1]);
  }
  write_file(file, text);
  // The power of x that the last two points show.
  const PlotPoint &last = curve.points.back(), &before = curve.points[curve.points.size() - 2];
  curve.label += fmt::format(", slope {:.1f}", (last[1] - before[1]) / (last[0] - before[0]));
  return curve;
}

/// Both axes logarithmic.
Panel panel_of(const std::string& title, const std::string& x, std::vector<Curve> curves) {
  Panel panel;
  panel.title = title;
  panel.x = {x, AxisScale::decimal};
  panel.y = {"milliseconds a step", AxisScale::decimal};
  panel.curves = std::move(curves);
  return panel;
}

}  // namespace

Figure cost_figure(const std::filesystem::path& folder) {
  std::vector<std::pair<double, double>> digits[2], stages[2];
  for (const SolverKind kind : {SolverKind::newton, SolverKind::paper}) {
    const std::size_t c = kind == SolverKind::paper;
    for (const unsigned d : {20U, 34U, 50U, 100U, 200U, 500U, 1000U}) {
      const PrecisionScope scope(d);
      const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene(satellites));
      digits[c].emplace_back(d, step_cost<Mpfr>(scene, 6, 4, Mpfr(1) / 10, kind, c ? 1 : 5).seconds);
    }
    const PrecisionScope scope(50);
    const Assembled<Mpfr> scene = assemble<Mpfr>(load_scene(satellites));
    for (const int s : {1, 2, 4, 8, 16})
      stages[c].emplace_back(s, step_cost<Mpfr>(scene, s + 2, s, Mpfr(1) / 10, kind, c ? 2 : 10).seconds);
  }
  std::vector<Row> unused;
  const auto bodies = chain_times<double>(unused, "double", 50);
  const PrecisionScope scope(50);
  const auto bodies50 = chain_times<Mpfr>(unused, "mpfr:50", 5);
  const auto curve = [&](const std::string& name, const auto& points, const std::string& label) {
    return curve_of(folder / (name + ".csv"), points, label);
  };
  Figure figure{"speed", "Time of a step", "", {}};
  figure.panels = {panel_of("HBVM(6,4), satellites", "digits",
                            {curve("digits_newton", digits[0], "newton"), curve("digits_paper", digits[1], "paper")}),
                   panel_of("HBVM(s + 2, s), 50 digits", "s",
                            {curve("stages_newton", stages[0], "newton"), curve("stages_paper", stages[1], "paper")}),
                   panel_of("Chain, HBVM(4,2), newton", "rods",
                            {curve("bodies_double", bodies, "double"), curve("bodies_mpfr50", bodies50, "50 digits")})};
  return figure;
}

}  // namespace hbvm::core::speed

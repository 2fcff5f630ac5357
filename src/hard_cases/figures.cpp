#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>

#include "hard_cases/report.hpp"
#include "integrate/integrate.hpp"
#include "measure.hpp"
#include "motion.hpp"
#include "problem/state_evaluator.hpp"
#include "round_off_growth.hpp"
#include "scalar/with_scalar.hpp"
#include "scene/assemble.hpp"
#include "scenes.hpp"
#include "step/hbvm_stepper.hpp"
#include "write_file.hpp"

namespace hbvm::core {
namespace {

using Points = std::vector<PlotPoint>;

/// A curve of a panel, with its data in a file of its own.
void add_curve(Panel& panel, const std::filesystem::path& csv, const std::string& head, const Points& points,
               const std::string& label) {
  std::string text = head + "\n";
  Curve curve{label, {}, true};
  for (const PlotPoint& point : points) {
    if (!std::isfinite(point[0]) || !std::isfinite(point[1])) continue;
    text += fmt::format("{:.6g},{:.6g}\n", point[0], point[1]);
    curve.points.push_back(point);
  }
  write_file(csv, text);
  panel.curves.push_back(std::move(curve));
}

/// A thin line of this slope through a point, with its name.
void add_slope(Panel& panel, double x, double y, double width, double slope, const std::string& name) {
  const PlotPoint end{x + width, y + slope * width};
  panel.lines.push_back({{{x, y}, end}});
  panel.labels.push_back({end, name});
}

/// Both axes logarithmic.
Panel panel_of(const std::string& title, const std::string& x, const std::string& y) {
  Panel panel;
  panel.title = title;
  panel.x = {x, AxisScale::decimal};
  panel.y = {y, AxisScale::decimal};
  return panel;
}

Figure figure_of(const std::string& name, const std::string& caption, Panel panel) {
  return {name, caption, "", {std::move(panel)}};
}

Figure growth(const std::filesystem::path& folder) {
  Panel panel = panel_of("What round-off does to the energy, in double", "steps", "change of H, units of round-off");
  struct Run {
    const char *scene, *method, *step, *label;
  };
  constexpr Run runs[] = {{"kepler", "hbvm:12,4", "1/32", "Kepler, (12,4)"},
                          {"double_pendulum", "hbvm:3,3", "1/32", "double pendulum, (3,3)"},
                          {"heavy_top", "hbvm:3,3", "1/32", "heavy top, (3,3)"}};
  for (const Run& run : runs) {
    const RoundOffGrowth walk =
        round_off_growth_of(request_of(load_scene(run.scene), run.method, "auto", run.step, "2^20/32", "double"));
    Points points;
    for (const Straying::Point& p : walk.H)
      points.push_back({std::log10(static_cast<double>(p.steps)), std::log10(p.distance)});
    add_curve(panel, folder / (std::string("growth_") + run.scene + ".csv"), "log10 steps,log10 units", points,
              run.label);
  }
  add_slope(panel, 3, -1, 2, 1 / double{2}, "n^{1/2}");
  add_slope(panel, 5, -1, 1, 1, "n");
  return figure_of("growth", "Round-off in the energy grows like the root of time", std::move(panel));
}

/// The error of a coordinate at the end, over its scale; at least an epsilon.
double relative_error(const RunRequest& request, std::size_t coordinate) {
  RunRequest more = request;
  more.precision = Precision::parse("mpfr:100");
  more.solver = SolverKind::fixed_point;
  const SampledMotion exact = motion_of(more), motion = motion_of(request);
  const PrecisionScope digits(100);
  const auto number = [](const BigFloat& x) { return rounded_to<Mpfr>(raw(x)); };
  const Mpfr error =
      magnitude(Mpfr(number(motion.samples.back().q[coordinate]) - number(exact.samples.back().q[coordinate])));
  const Mpfr scale = number(exact.scale.q[coordinate]);
  return std::max(approximately(Mpfr(error / scale)), epsilon<double>());
}

/// Points of a file that an earlier program made; none if it is not there.
Points points_of(const std::string& path) {
  Points points;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    double x = 0, y = 0;
    if (!line.starts_with('#') && std::sscanf(line.c_str(), "%lf,%lf", &x, &y) == 2) points.push_back({x, y});
  }
  return points;
}

void add_before(Panel& panel, const std::string& path, const std::string& label) {
  const Points points = points_of(path);
  if (!points.empty()) panel.curves.push_back({label, points, true});
}

Figure separatrix(const std::filesystem::path& folder, const std::filesystem::path& before) {
  Panel panel =
      panel_of("A pendulum near upright: what is left at t = 8", "angle from upright", "error of x over x, double");
  for (const char* const solver : {"auto", "newton"}) {
    Points points;
    for (int j = 30; j >= 0; j -= 2)
      points.push_back(
          {static_cast<double>(-j),
           std::log10(relative_error(
               request_of(near_upright(fmt::format("10^(-{})/2", j)), "hbvm:8,8", solver, "1/4", "8", "double"), 0))});
    add_curve(panel, folder / (std::string("separatrix_") + solver + ".csv"), "log10 angle,log10 error", points,
              solver);
  }
  add_before(panel, (before / "separatrix_before.csv").string(), "auto, before");
  return figure_of("separatrix", "Digits of a pendulum near upright", std::move(panel));
}

Figure light_body(const std::filesystem::path& folder, const std::filesystem::path& before) {
  Panel panel = panel_of("A light body beside a heavy one, after two orbits", "mass of the light body",
                         "error of its position, double");
  Points points;
  for (int j = 0; j <= 16; ++j)
    points.push_back(
        {static_cast<double>(-j), std::log10(relative_error(request_of(beside_kepler(fmt::format("10^(-{})", j)),
                                                                       "hbvm:6,2", "auto", "2*pi/64", "4*pi", "double"),
                                                            3))});
  add_before(panel, (before / "light_body_before.csv").string(), "before");
  add_curve(panel, folder / "light_body.csv", "log10 mass,log10 error", points, "now");
  return figure_of("light_body", "The error of a body does not depend on who else is there", std::move(panel));
}

/// e_hid so far, at every power of two of steps.
template <Scalar S>
class HiddenSoFar final : public Observer<S> {
 public:
  HiddenSoFar(const Problem<S>& problem, const TimeGrid<S>& grid) : point_(problem), grid_(grid) {}
  void observe(const Snapshot<S>& snapshot) override {
    raise_to(greatest_, max_norm(point_.hidden_constraints(snapshot.q, snapshot.p)));
    const long n = snapshot.n;
    if (n > 8 && ((n & (n - 1)) == 0 || n == grid_.steps()))
      points.push_back({std::log10(approximately(snapshot.t)), std::log10(approximately(greatest_))});
  }
  Points points;

 private:
  StateEvaluator<S> point_;
  const TimeGrid<S>& grid_;
  S greatest_ = 0;
};

Figure hidden(const std::filesystem::path& folder) {
  Panel panel = panel_of("Heavy top, h = 1/10: the hidden constraint so far", "t", "e_{hid}");
  const Assembled<double> scene = assemble<double>(load_scene("heavy_top"));
  const TimeGrid<double> grid(Expression::parse("1/10"), Expression::parse("6553.6"));
  for (int s = 1; s <= 4; ++s) {
    const Hbvm<double> method = make_hbvm<double>(s, s);
    HbvmStepper<double> stepper(scene.problem, method, SolverKind::automatic);
    State<double> state(scene.q0, scene.p0);
    HiddenSoFar<double> observer(scene.problem, grid);
    integrate<double>(stepper, state, grid, {&observer});
    add_curve(panel, folder / fmt::format("hidden_{}.csv", s), "log10 t,log10 e_hid", observer.points,
              fmt::format("s = {}", s));
  }
  return figure_of("hidden", "For even s the hidden constraint grows, for odd s it does not", std::move(panel));
}

}  // namespace

std::vector<Figure> stability_figures(const std::string& folder, const std::string& before) {
  return {growth(folder), separatrix(folder, before), light_body(folder, before), hidden(folder)};
}

}  // namespace hbvm::core

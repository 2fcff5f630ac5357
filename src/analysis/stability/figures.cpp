#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>

#include "hbvm/analysis/stability/report.hpp"
#include "hbvm/integrate/integrate.hpp"
#include "hbvm/problem/point.hpp"
#include "hbvm/scalar/with_scalar.hpp"
#include "hbvm/scene/assemble.hpp"
#include "hbvm/step/hbvm_stepper.hpp"
#include "hbvm/write_file.hpp"
#include "measure.hpp"
#include "motion.hpp"
#include "scenes.hpp"
#include "walk.hpp"

namespace hbvm {
namespace {

using Points = std::vector<std::pair<double, double>>;

/// A curve of a panel, with its data in a file of its own.
void add_curve(Panel& panel, const std::filesystem::path& csv, const std::string& head, const Points& points,
               const std::string& label) {
  std::string text = "# " + head + "\n";
  for (const auto& [x, y] : points)
    if (std::isfinite(x) && std::isfinite(y)) text += fmt::format("{:.6g},{:.6g}\n", x, y);
  write_file(csv, text);
  Curve curve{csv.string(), 1, 2, 0, label};
  curve.points = true;
  panel.curves.push_back(curve);
}

/// A thin line of this slope through a point of the first curve, with its name.
void add_slope(Panel& panel, double x, double y, double width, double slope, const std::string& name) {
  const auto text = [](double value) { return fmt::format("{:.6g}", value); };
  panel.lines.push_back({{{text(x), text(y)}, {text(x + width), text(y + slope * width)}}, ""});
  panel.labels.push_back({{text(x + width), text(y + slope * width)}, " " + name});
}

Figure figure_of(const std::string& name, const std::string& caption, Panel panel) {
  Figure figure;
  figure.name = name;
  figure.caption = caption;
  figure.panels.push_back(std::move(panel));
  return figure;
}

Figure growth(const std::filesystem::path& folder) {
  Panel panel;
  panel.title = "What round-off does to the energy, in double";
  panel.x_label = "steps";
  panel.y_label = "change of H, units of round-off";
  panel.x_decades = 1;
  panel.y_decades = 1;
  struct Run {
    const char *scene, *method, *step, *label;
  };
  constexpr Run runs[] = {{"kepler", "hbvm:12,4", "1/32", "Kepler, (12,4)"},
                          {"double_pendulum", "hbvm:3,3", "1/32", "double pendulum, (3,3)"},
                          {"heavy_top", "hbvm:3,3", "1/32", "heavy top, (3,3)"}};
  for (const Run& run : runs) {
    const Walk walk = walk_of(request_of(load_scene(run.scene), run.method, "auto", run.step, "2^20/32", "double"));
    Points points;
    for (const Straying::Point& p : walk.H)
      points.emplace_back(std::log10(static_cast<double>(p.steps)), std::log10(p.distance));
    add_curve(panel, folder / (std::string("growth_") + run.scene + ".csv"), "log10 steps,log10 units", points,
              run.label);
  }
  add_slope(panel, 3, -1, 3, 1 / double{2}, "n^{1/2}");
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
    if (!line.starts_with('#') && std::sscanf(line.c_str(), "%lf,%lf", &x, &y) == 2) points.emplace_back(x, y);
  }
  return points;
}

void add_before(Panel& panel, const std::string& path, const std::string& label) {
  if (points_of(path).empty()) return;
  Curve curve{path, 1, 2, 0, label};
  curve.points = true;
  panel.curves.push_back(curve);
}

Figure separatrix(const std::filesystem::path& folder, const std::filesystem::path& before) {
  Panel panel;
  panel.title = "A pendulum near upright: what is left at t = 8";
  panel.x_label = "angle from upright";
  panel.y_label = "error of x over x, double";
  panel.x_decades = 5;
  panel.y_decades = 2;
  for (const char* const solver : {"auto", "newton"}) {
    Points points;
    for (int j = 0; j <= 30; j += 2)
      points.emplace_back(
          -j,
          std::log10(relative_error(
              request_of(near_upright(fmt::format("10^(-{})/2", j)), "hbvm:8,8", solver, "1/4", "8", "double"), 0)));
    add_curve(panel, folder / (std::string("separatrix_") + solver + ".csv"), "log10 angle,log10 error", points,
              solver);
  }
  add_before(panel, (before / "separatrix_before.csv").string(), "auto, before");
  return figure_of("separatrix", "Digits of a pendulum near upright", std::move(panel));
}

Figure light_body(const std::filesystem::path& folder, const std::filesystem::path& before) {
  Panel panel;
  panel.title = "A light body beside a heavy one, after two orbits";
  panel.x_label = "mass of the light body";
  panel.y_label = "error of its position, double";
  panel.x_decades = 2;
  panel.y_decades = 2;
  Points points;
  for (int j = 0; j <= 16; ++j)
    points.emplace_back(-j, std::log10(relative_error(request_of(beside_kepler(fmt::format("10^(-{})", j)), "hbvm:6,2",
                                                                 "auto", "2*pi/64", "4*pi", "double"),
                                                      3)));
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
      points.emplace_back(std::log10(approximately(snapshot.t)), std::log10(approximately(greatest_)));
  }
  Points points;

 private:
  Point<S> point_;
  const TimeGrid<S>& grid_;
  S greatest_ = 0;
};

Figure hidden(const std::filesystem::path& folder) {
  Panel panel;
  panel.title = "Heavy top, h = 1/10: the hidden constraint so far";
  panel.x_label = "t";
  panel.y_label = "e_{hid}";
  panel.x_decades = 1;
  panel.y_decades = 1;
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

}  // namespace hbvm

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "audit/report.hpp"
#include "audit/slope_triangle.hpp"
#include "measurements.hpp"
#include "scalar/with_scalar.hpp"
#include "step/hbvm_method.hpp"
#include "write_file.hpp"

namespace hbvm::core {
namespace {

/// One curve: errors over an interval of the modified pendulum, in one precision.
struct Line {
  Quantity quantity;
  MethodPtr method;
  std::string precision, label;
};

std::vector<Rung> rungs_of(const Line& line) {
  ClaimGroup group;
  group.claims.resize(1);
  group.claims[0].quantity = line.quantity;
  group.claims[0].problem = "modified_pendulum";
  group.claims[0].method = line.method;
  const Ladders ladders = with_scalar(Precision::parse(line.precision), [&]<Scalar S>() {
    return interval_ladder<S>(group, 8'192, [](const Ladders&) { return false; });
  });
  return ladders.at(line.quantity);
}

std::string text_of(double x) { return std::isfinite(x) ? fmt::format("{:.6g}", x) : ""; }

/// A panel of some lines, whose numbers are kept in a file; `slopes`: of which line, its slope.
Panel panel_of(const std::string& title, const std::vector<Line>& lines,
               const std::vector<std::pair<std::size_t, int>>& slopes, const std::string& csv) {
  Panel panel;
  panel.title = title;
  panel.x = {"step h", AxisScale::binary};
  panel.y = {"error over [0, 1/2]", AxisScale::decimal};
  std::vector<std::vector<Rung>> ladders;
  std::string text = "log2 h";
  for (const Line& line : lines) {
    ladders.push_back(rungs_of(line));
    text += ",log10 of the error of " + line.label;
    Curve& curve = panel.curves.emplace_back(Curve{line.label, {}, true});
    for (const Rung& rung : ladders.back()) curve.points.push_back({rung.step, rung.error * log10_of_2});
  }
  text += "\n";
  for (std::size_t i = 0; i < ladders.front().size(); ++i) {
    text += text_of(ladders.front()[i].step);
    for (const auto& rungs : ladders) text += "," + text_of(rungs.at(i).error * log10_of_2);
    text += "\n";
  }
  write_file(csv, text);
  for (const auto& [line, slope] : slopes)
    add_slope_triangle(panel, slope_triangle(ladders[line], ladders[line].size() - 3, slope));
  return panel;
}

}  // namespace

Figure audit_figure(const std::string& folder) {
  const std::filesystem::path path(folder);
  const auto in_all_precisions = [](Quantity quantity, const MethodPtr& method) {
    return std::vector<Line>{{quantity, method, "mpfr:50", "50 digits"},
                             {quantity, method, precision_of_34_digits(), precision_of_34_digits()},
                             {quantity, method, "double", "double"}};
  };
  Figure figure;
  figure.name = "orders";
  figure.panels.push_back(panel_of("Position, HBVM(4,4): order 8", in_all_precisions(Quantity::q, hbvm_of({4, 4})),
                                   {{0, 8}}, (path / "position.csv").string()));
  figure.panels.push_back(panel_of("Energy, HBVM(4,2): order 8", in_all_precisions(Quantity::H, hbvm_of({4, 2})),
                                   {{0, 8}}, (path / "energy.csv").string()));
  const MethodPtr method = hbvm_of({2, 2});
  figure.panels.push_back(panel_of("HBVM(2,2), 50 digits: what converges how",
                                   {{Quantity::lagmul, method, "mpfr:50", "propagated λ"},
                                    {Quantity::p, method, "mpfr:50", "propagated p"},
                                    {Quantity::tangential_p, method, "mpfr:50", "tangential p"},
                                    {Quantity::q, method, "mpfr:50", "q"}},
                                   {{0, 1}, {1, 2}, {3, 4}}, (path / "components.csv").string()));
  return figure;
}

}  // namespace hbvm::core

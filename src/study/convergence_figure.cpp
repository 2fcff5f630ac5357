#include "study/convergence_figure.hpp"

#include <cmath>
#include <map>

#include "audit/slope_triangle.hpp"
#include "hbvm/version.hpp"

namespace hbvm::core {

Figure convergence_figure(const ConvergenceWork& work, const std::vector<MeasuredConvergence>& measured,
                          const std::string& command) {
  Figure figure;
  figure.caption = plain(work.request.scene.title);
  figure.footnote = std::string("hbvm ") + version() + ": " + command;
  for (std::size_t part = 0; part < end_part_names.size(); ++part) {
    Panel panel;
    const std::string symbol = part == 2 ? "λ" : end_part_names[part];
    panel.title = "Error of " + symbol + (part == 0 ? "" : work.propagated ? ", propagated" : " of the output state");
    panel.x = {"step h", AxisScale::binary};
    panel.y = {"error at t = " + plain(work.request.until.text()), AxisScale::decimal};
    panel.labels_beside = true;
    std::map<int, std::vector<std::vector<Rung>>> slopes;
    for (const MeasuredConvergence& one : measured) {
      const std::vector<Rung>& rungs = one.rungs[part];
      if (rungs.empty()) continue;
      const std::string precision = work.precisions.size() > 1 ? ", " + one.precision : "";
      Curve& curve = panel.curves.emplace_back(Curve{plain(one.method + precision), {}, true});
      for (const Rung& rung : rungs) curve.points.push_back({rung.step, rung.error * log10_of_2});
      if (one.rates[part] && one.precision == work.precisions.back().name() && rungs.size() > 2)
        slopes[static_cast<int>(std::lround(one.rates[part]->value))].push_back(rungs);
    }
    add_slope_triangles(panel, slopes);
    if (!panel.curves.empty()) figure.panels.push_back(std::move(panel));
  }
  return figure;
}

}  // namespace hbvm::core

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cost/cost_report.hpp"
#include "step/hbvm_method.hpp"

namespace hbvm::core {
namespace {

enum Part : std::size_t { forces, constraints, products, corrections, in_double, rest };

bool holds_any(const std::string& name, std::initializer_list<const char*> words) {
  return std::any_of(words.begin(), words.end(), [&](const char* w) { return name.find(w) != std::string::npos; });
}

/// By the names that steppers give their parts.
Part part_of(const AccountLine& line, bool all_in_double) {
  switch (line.kind) {
    case AccountLine::Kind::effect:
      return forces;
    case AccountLine::Kind::in_double:
      return in_double;
    case AccountLine::Kind::rest:
      return rest;
    case AccountLine::Kind::part:
      break;
  }
  if (holds_any(line.name, {"LU", "multipliers at the nodes"})) return all_in_double ? in_double : constraints;
  if (holds_any(line.name, {"constraint", "multiplier", "tangential"})) return constraints;
  if (holds_any(line.name, {"coefficient", "position", "velocit", "momentum", "drift", "stage"})) return products;
  return corrections;
}

/// The run that stands for a precision, of those of HBVM that came to their end. It is the one with the most digits; of
/// equally many, within one, the quickest.
const CostFinding* bar_of(const CostStudy& study, const CostOutcome& outcome, const Precision& precision) {
  const CostFinding* best = nullptr;
  for (const CostFinding& f : outcome.findings) {
    if (!(f.cell.precision == precision) || !f.measured.failure.empty() || f.measured.account.empty()) continue;
    if (!as_hbvm(*f.cell.method)) continue;
    const double error = f.measured.errors.of(study.quantity);
    const double least = best ? best->measured.errors.of(study.quantity) : 0;
    if (!best || error < least - 1 || (error < least + 1 && f.measured.seconds < best->measured.seconds)) best = &f;
  }
  return best;
}

}  // namespace

std::array<double, cost_parts.size()> part_shares(const std::vector<AccountLine>& account, bool all_in_double) {
  std::array<double, cost_parts.size()> shares{};
  double all = 0;
  for (const AccountLine& line : account) {
    shares[part_of(line, all_in_double)] += line.seconds;
    all += line.seconds;
  }
  for (double& share : shares) share = all > 0 ? share / all : 0;
  return shares;
}

Figure breakdown_figure(const CostStudy& study, const CostOutcome& outcome) {
  Figure figure;
  figure.name = "breakdown";
  Panel& panel = figure.panels.emplace_back();
  panel.title = plain(study.scene.name) + ": where the time of a step goes";
  panel.y = {"share of the processor time / %"};
  for (const std::string_view part : cost_parts) panel.curves.push_back({std::string(part), {}});
  std::vector<Precision> precisions;
  for (const CostFinding& f : outcome.findings)
    if (precisions.empty() || !(precisions.back() == f.cell.precision)) precisions.push_back(f.cell.precision);
  for (const Precision& precision : precisions) {
    const CostFinding* const f = bar_of(study, outcome, precision);
    if (!f) continue;
    const auto x = static_cast<double>(panel.x.names.size());
    const double milliseconds = 1000 * f->measured.seconds / static_cast<double>(f->cell.steps);
    panel.x.names.push_back(
        fmt::format("{}\n({})\n{:.2g} ms", precision.name(), f->measured.method.substr(5), milliseconds));
    double below = 0;
    const auto shares = part_shares(f->measured.account, precision.kind() == Precision::Kind::binary64);
    for (std::size_t part = 0; part < shares.size(); ++part) {
      const double percent = 100 * shares[part];
      panel.bars.push_back({x, below, below + percent, part});
      // Labels stand beside the last bar.
      panel.curves[part].points = {{x + double{1} / 2, below + percent / 2}};
      below += percent;
    }
  }
  panel.x.label = "precision; k, s; time of a step";
  return figure;
}

}  // namespace hbvm::core

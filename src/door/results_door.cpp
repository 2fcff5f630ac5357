#include <algorithm>

#include "compare/comparison.hpp"
#include "door/door.hpp"
#include "hbvm/results.hpp"
#include "long_work/json.hpp"

namespace hbvm {
namespace {

/// As many digits at the last time as the best file has.
PlanRequest request_of_plan(const ResultsRequest& door, const Comparison& against) {
  const FileComparison* best = &against.files.front();
  for (const FileComparison& file : against.files)
    if (file.error < best->error) best = &file;
  const double digits = std::clamp(-best->error, double{1}, static_cast<double>(against.digits));
  PlanRequest request{.scene = door.scene, .until = best->times.back(), .digits = static_cast<int>(digits)};
  request.quantity = "q";
  request.progress = door.progress;
  request.stop = door.stop;
  return request;
}

}  // namespace

Comparison compare_results(const ResultsRequest& door) {
  const core::Admitted admitted(door.stop);
  if (door.files.empty()) throw InputError("no results to compare are named");
  core::ComparisonRequest request;
  request.scene = core::scene_of(door.scene);
  request.files = door.files;
  request.map = door.map;
  request.progress = core::watched(door.progress);
  Comparison against = core::compare_with_reference(request);
  if (door.cost) against.plan = plan(request_of_plan(door, against));
  return against;
}

Figure figure_of(const Comparison& against, const std::string& scene) {
  return core::comparison_figure(against, scene);
}

std::string to_json(const Comparison& against) {
  core::OrderedJson j{{"digits", against.digits}, {"files", core::OrderedJson::array()}};
  for (const FileComparison& file : against.files) {
    core::OrderedJson entry{{"name", file.name}, {"t", file.times}, {"unused", file.unused}};
    entry["start"] = file.has_start ? core::OrderedJson::array() : core::OrderedJson(nullptr);
    for (const StartDifference& d : file.start)
      entry["start"].push_back({{"name", d.name}, {"theirs", d.theirs}, {"scene", d.ours}});
    for (const ComponentDigits& c : file.components) entry["right_digits"][c.name] = c.digits;
    entry["log10_H_drift"] = file.H_drift;
    entry["log10_g_drift"] = file.g_drift;
    entry["log10_hidden_drift"] = file.hidden_drift;
    entry["by_growth"] = file.by_growth;
    entry["mostly"] = file.mostly ? core::OrderedJson(name_of(*file.mostly)) : core::OrderedJson(nullptr);
    entry["step"] = file.step;
    entry["reference"] = file.stored ? "stored" : "computed now";
    j["files"].push_back(entry);
  }
  j["by_growth"] = against.files.front().by_growth;
  j["orders"] = core::OrderedJson::array();
  j["order_between"] = core::OrderedJson::array();
  for (const OrderBetween& c : against.orders) {
    j["orders"].push_back(c.order);
    j["order_between"].push_back({against.files[c.coarse].name, against.files[c.fine].name});
  }
  if (against.measured_order)
    j["order"] = {{"value", against.measured_order->value}, {"uncertainty", against.measured_order->uncertainty}};
  if (against.plan) j["cost"] = core::OrderedJson::parse(against.plan->json);
  return core::dumped(j, 2);
}

}  // namespace hbvm

#include "cost/cost_reference.hpp"

#include "hbvm/version.hpp"
#include "long_work/json.hpp"
#include "reference/store.hpp"

namespace hbvm::core {
namespace {

std::string routes_of(const Reference& reference) {
  std::string text;
  for (const RouteReport& route : reference.routes) text += (text.empty() ? "" : "; ") + route.settings;
  return text;
}

}  // namespace

CostReference find_cost_reference(const CostReferenceRequest& request) {
  const Scene& scene = *request.scene;
  if (const auto shipped = find_reference(scene, request.until, request.digits))
    return {shipped->state, shipped->digits, "shipped: " + shipped->name};
  const std::string key = "reference|" + scene_hash(scene) + "|" + request.until.text() + "|" +
                          std::to_string(request.digits) + (request.confirmed ? "" : "|taylor");
  Reference reference;
  const std::string* const known = request.store ? request.store->find(key) : nullptr;
  if (known) {
    reference = read_json(*known, "a reference", [&](const OrderedJson& json) {
      return read_reference(json.at("toml").get<std::string>(), key).reference;
    });
  } else {
    ReferenceRequest computed;
    computed.scene = scene;
    computed.times = {request.until};
    computed.digits = request.digits;
    if (!request.confirmed) computed.only = Route::taylor;
    computed.progress = request.progress;
    reference = compute_reference(computed);
    if (request.store) request.store->add(key, dumped({{"toml", to_toml({reference, version(), "unknown"})}}, -1));
  }
  return {reference.times.front(), reference.digits, routes_of(reference)};
}

MotionNature find_nature(const Scene& scene, const Expression& until, CellStore* store,
                         const std::function<void(double)>& progress) {
  const std::string key = "nature|" + scene_hash(scene) + "|" + until.text();
  if (const std::string* const known = store ? store->find(key) : nullptr)
    return read_json(*known, "the nature of a motion", [](const OrderedJson& json) {
      return MotionNature{json.at("digits_lost").get<double>(), json.at("log2_radius").get<double>()};
    });
  const MotionNature nature = nature_of(
      scene, {until}, progress ? progress : [](double) {});
  if (store) store->add(key, dumped({{"digits_lost", nature.digits_lost}, {"log2_radius", nature.log2_radius}}, -1));
  return nature;
}

}  // namespace hbvm::core

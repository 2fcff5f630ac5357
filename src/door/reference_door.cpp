#include "clock.hpp"
#include "door/door.hpp"
#include "hbvm/reference.hpp"
#include "hbvm/version.hpp"
#include "long_work/json.hpp"
#include "reference/check_proof.hpp"
#include "reference/compute_reference.hpp"
#include "reference/event_times.hpp"
#include "reference/literals.hpp"

namespace hbvm {

Reference reference(const ReferenceRequest& door) {
  const core::Admitted admitted(door.stop);
  core::ReferenceRequest request;
  request.scene = core::scene_of(door.scene);
  for (const Number& time : door.times) request.times.push_back(core::expression_of(time, "a time of the reference:"));
  if (request.times.empty()) throw InputError("a reference of no times: say at which");
  request.digits = door.digits;
  if (!door.route.empty()) request.only = core::parse_route(door.route);
  request.force = door.force;
  request.prove = door.prove;
  request.progress = core::watched(door.progress);
  if (!door.keep_proof) return core::compute_reference(request);
  if (!door.prove) throw InputError("a reference without proof has none to keep");
  core::ProofFile file;
  request.proof = &file.proof;
  Reference result = core::compute_reference(request);
  file.claim = {result, version(), core::today()};
  result.proof = core::to_text(file);
  return result;
}

std::vector<ReferenceEvent> reference_events(const ReferenceRequest& door) {
  const core::Admitted admitted(door.stop);
  if (door.prove || !door.route.empty()) throw InputError("the events of a reference are found by two routes");
  core::ReferenceRequest request;
  request.scene = core::scene_of(door.scene);
  for (const Number& time : door.times) request.times.push_back(core::expression_of(time, "a time of the reference:"));
  if (request.times.empty()) throw InputError("the events of a reference: say until when");
  if (request.scene.events.empty()) throw InputError("the scene has no event");
  request.digits = door.digits;
  request.force = door.force;
  request.progress = core::watched(door.progress);
  std::vector<ReferenceEvent> events;
  for (const core::EventTime& event : core::event_times(request))
    events.push_back({event.name, event.rises, Number(event.t.text())});
  return events;
}

Reference check_proof(const ProofRequest& request) {
  const core::Admitted admitted(request.stop);
  return core::check_proof(core::read_proof(request.text, request.name), core::watched(request.progress));
}

std::string to_literals(const Reference& reference, const std::string& language) {
  return core::to_literals(reference, core::parse_language(language));
}

std::string to_json(const Reference& r, const std::string& command) {
  core::OrderedJson j{{"scene", r.scene}, {"until", r.times.back().t}, {"digits", r.digits}};
  if (r.proved > 0) j["proved"] = r.proved;
  j["names"] = {{"q", r.q_names}, {"p", r.p_names}, {"lambda", r.lambda_names}};
  j["times"] = core::OrderedJson::array();
  for (const ReferenceState& state : r.times) {
    core::OrderedJson entry{{"t", state.t}, {"q", state.q}, {"p", state.p}, {"lambda", state.lambda}, {"H", state.H}};
    entry["momenta"] = core::OrderedJson::object();
    for (std::size_t i = 0; i < state.momenta.size(); ++i) entry["momenta"][r.momentum_names[i]] = state.momenta[i];
    for (std::size_t i = 0; i < state.observed.size(); ++i) entry["observed"][r.observed_names[i]] = state.observed[i];
    entry["agreed"] = r.routes.size() > 1 ? core::OrderedJson(state.agreed) : core::OrderedJson(nullptr);
    if (state.digits_lost) entry["digits_lost"] = *state.digits_lost;
    if (state.radius)
      entry["radius"] = {
          {"q", state.radius->q}, {"p", state.radius->p}, {"lambda", state.radius->lambda}, {"H", state.radius->H}};
    j["times"].push_back(entry);
  }
  j["routes"] = core::OrderedJson::array();
  for (const RouteReport& route : r.routes)
    j["routes"].push_back({{"name", route.name}, {"settings", route.settings}, {"cpu_seconds", route.cpu_seconds}});
  j["digits_lost"] = r.digits_lost;
  j["scene_hash"] = r.scene_hash;
  j["version"] = version();
  j["command"] = command;
  return core::dumped(j, 2);
}

}  // namespace hbvm

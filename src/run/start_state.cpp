#include "run/start_state.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "problem/constraint.hpp"
#include "scalar/literal.hpp"
#include "scalar/text.hpp"

namespace hbvm::core {
namespace {

using Json = nlohmann::json;

[[noreturn]] void refuse(const std::string& file, const std::string& why) {
  throw InputError("--start: '" + file + "': " + why);
}

std::string entry(const char* key, std::size_t i) {
  return "'" + std::string(key) + "', entry " + std::to_string(i + 1) + ": ";
}

SceneVector numbers(const Json& object, const char* key, const std::string& file) {
  if (!object.contains(key)) refuse(file, "it has no '" + std::string(key) + "'");
  const Json& list = object[key];
  if (!list.is_array()) refuse(file, "'" + std::string(key) + "' is no list");
  SceneVector result;
  for (const Json& number : list) {
    const std::string place = entry(key, result.size());
    if (!number.is_string()) refuse(file, place + number.dump() + " is no text; write it as \"" + number.dump() + "\"");
    try {
      result.push_back(Expression::parse(number.get<std::string>()));
    } catch (const InputError& error) {
      refuse(file, place + error.what());
    }
  }
  return result;
}

std::string file_name(const std::string& scene) { return std::filesystem::path(scene).filename().string(); }

}  // namespace

StartState read_start_state(const std::string& json, const std::string& file) {
  const Json object = Json::parse(json, nullptr, false);
  if (object.is_discarded()) refuse(file, "it is no JSON");
  if (!object.is_object()) refuse(file, "it is no JSON object");
  StartState start{file, {}, numbers(object, "q", file), numbers(object, "p", file), {}, {}};
  if (object.contains("q_carry") || object.contains("p_carry")) {
    start.q_carry = numbers(object, "q_carry", file);
    start.p_carry = numbers(object, "p_carry", file);
  }
  if (object.contains("scene")) {
    if (!object["scene"].is_string()) refuse(file, "'scene' is no text");
    start.scene = object["scene"].get<std::string>();
  }
  return start;
}

template <Scalar S>
State<S> evaluate(const StartState& start, const Scene& text, const Assembled<S>& scene) {
  // The same file may have been named by another path.
  if (!start.scene.empty() && file_name(start.scene) != file_name(text.name))
    refuse(start.file, "'scene' is '" + start.scene + "', and the run's is '" + text.name + "'");
  const auto set = [&](Vector<S>& x, const SceneVector& from, const char* key) {
    if (static_cast<Index>(from.size()) != x.size())
      refuse(start.file, "'" + std::string(key) + "' has " + std::to_string(from.size()) + " entries, and '" +
                             text.name + "' has " + std::to_string(x.size()) + " coordinates");
    for (std::size_t i = 0; i < from.size(); ++i) {
      try {
        x[static_cast<Index>(i)] = evaluate<S>(from[i], text.constants);
      } catch (const InputError& error) {
        refuse(start.file, entry(key, i) + error.what());
      }
    }
  };
  State<S> state(scene.q0, scene.p0);
  set(state.q, start.q, "q");
  set(state.p, start.p, "p");
  if (!start.q_carry.empty() || !start.p_carry.empty()) {
    set(state.q_carry, start.q_carry, "q_carry");
    set(state.p_carry, start.p_carry, "p_carry");
  }
  // What ten million roundings may add up to.
  constexpr long gathered = 1L << 16;
  const S tolerance = S(gathered) * epsilon<S>();
  std::size_t number = 0;
  for (const Constraint<S>& constraint : scene.problem.constraints) {
    ++number;
    const auto here = value(constraint, scene.problem.dimension, state.q);
    if (!(magnitude(here.g) <= S(tolerance * here.size)))
      refuse(start.file, "'q' does not lie on constraint " + std::to_string(number) + " (" + constraint.name +
                             "): residual " + to_scientific(here.g, 3) + ", tolerance " +
                             to_scientific(S(tolerance * here.size), 3) + " at this precision");
  }
  return state;
}

#define HBVM_DEFINE(S) template State<S> evaluate<S>(const StartState&, const Scene&, const Assembled<S>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

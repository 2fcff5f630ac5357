#pragma once

#include <string>

#include "scene/assemble.hpp"
#include "step/state.hpp"

namespace hbvm::core {

/// A state to start from instead of that of the scene, as exact text: what `hbvm run --json` prints holds one.
struct StartState {
  std::string file;   ///< for messages
  std::string scene;  ///< the name of its scene; empty if it names none
  SceneVector q, p;
  SceneVector q_carry, p_carry;  ///< what rounding took from q and p; both empty if unknown
};

/// Reads a JSON object with "q" and "p", lists of numbers or expressions as text, and if they are there "q_carry",
/// "p_carry" and "scene". All other keys are passed over; time begins at 0 anew.
/// \throws InputError with file and key
StartState read_start_state(const std::string& json, const std::string& file);

/// The state in the working precision. Its positions must lie on the constraints, to the round-off that a long run
/// gathers. Its momenta may leave the hidden constraints by any amount, as the propagated p does.
/// \throws InputError with file and key if not; for a wrong number of entries; if it names another scene
template <Scalar S>
State<S> evaluate(const StartState& start, const Scene& text, const Assembled<S>& scene);

}  // namespace hbvm::core

#pragma once

#include <vector>

#include "run/scene_run.hpp"
#include "scalar/big_float.hpp"

namespace hbvm::core {

/// A state, free of its number type: every number exactly.
struct ExactState {
  std::vector<BigFloat> q, p;
};

/// What a run shows of its motion.
struct SampledMotion {
  std::vector<ExactState> samples;  ///< at the start, and at eight times or fewer up to the end
  ExactState scale;                 ///< of each coordinate: the greatest |q_i|, h |v_i| and |p_i| and
                                    ///< h times each force on it
  long steps = 0;
};

/// Changes that a run makes on purpose. A kick multiplies each coordinate by 1 + 2^-bits or 1 - 2^-bits, and changes
/// each constraint and hidden constraint by 2^-bits of its terms. Where the constraints' gradients are nearly
/// dependent, that is far more than the former of the coordinates.
struct Twist {
  long kick_bits = 0;  ///< kicks at the start and at every eighth of the run; 0: none
  bool back = false;   ///< at the end momenta are reversed, and as many steps lead back
};

/// The motion of a run with a method whose k is stated; the number of digits is the request's.
/// \throws StepError, InputError
SampledMotion motion_of(const RunRequest& request, const Twist& twist = {});

}  // namespace hbvm::core

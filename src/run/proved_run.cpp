#include "run/proved_run.hpp"

#include "hbvm/error.hpp"
#include "run_beside.hpp"
#include "scene/moving_point.hpp"
#include "step/hbvm_method.hpp"

namespace hbvm::core {

void check_provable(const RunRequest& request) {
  const auto refuse = [](const std::string& why) { throw InputError("a proof of the steps is asked for, but " + why); };
  const HbvmMethod* const hbvm = as_hbvm(*request.method);
  if (!hbvm || hbvm->perturbation()) refuse("the method is " + request.method->text() + ": use hbvm:K,S or gauss:S");
  if (request.start) refuse("the run starts from a file, and not from the exact start of the scene");
  if (names_work(request.scene)) refuse("the scene has forces without a potential, or names t");
  if (request.on_failure == OnFailure::halve) refuse("steps may be divided: take a step that need not be");
}

template <Scalar S>
ProvedSteps prove_run(const RunRequest& request, const Method& method, const NodeLog& nodes, const State<S>& end,
                      const std::function<void(long, long)>& progress) {
  if (!nodes.raised.empty())
    throw InputError("the steps have different numbers of nodes, of which there is no proof: name one, as hbvm:" +
                     std::to_string(nodes.raised.back().k) + "," + std::to_string(as_hbvm(method)->name().s));
  const PrecisionScope more(digits_of_a_run_beside<S>());
  return prove_steps({.scene = request.scene,
                      .method = as_hbvm(method)->name(),
                      .step = request.step,
                      .until = request.until,
                      .direction = request.direction,
                      .digits = static_cast<int>(request.precision.digits()),
                      .progress = progress},
                     exact_state(end));
}

#define HBVM_DEFINE(S)                                                                                 \
  template ProvedSteps prove_run<S>(const RunRequest&, const Method&, const NodeLog&, const State<S>&, \
                                    const std::function<void(long, long)>&);
HBVM_FOR_EACH_SCALAR(HBVM_DEFINE)

}  // namespace hbvm::core

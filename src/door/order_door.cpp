#include "audit/convergence.hpp"
#include "audit/finding.hpp"
#include "hbvm/order.hpp"

namespace hbvm {

std::optional<MeasuredRate> measured_rate(const std::vector<StepError>& ladder) {
  std::vector<core::Rung> rungs;
  for (const StepError& one : ladder) rungs.push_back({one.step, one.error, one.floor});
  const std::optional<core::Rate> rate = core::convergence_rate(rungs);
  if (!rate) return std::nullopt;
  return MeasuredRate{rate->value, rate->uncertainty};
}

std::string order_verdict(const std::optional<MeasuredRate>& rate, double order) {
  core::Claim claim;
  claim.predicted = order;
  claim.form = core::Form::at_least;
  std::optional<core::Rate> judged;
  if (rate) judged = core::Rate{rate->value, rate->uncertainty};
  return std::string(core::name_of(core::judge(claim, judged)));
}

}  // namespace hbvm

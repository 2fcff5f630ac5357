#include "audit/finding.hpp"

#include <cmath>

namespace hbvm::core {

std::string_view name_of(Verdict verdict) {
  constexpr std::string_view names[] = {"holds", "fails", "undecidable", "degenerate", "not run"};
  return names[static_cast<int>(verdict)];
}

Verdict judge(const Claim& claim, const std::optional<Rate>& rate) {
  if (!rate || std::isnan(rate->value) || !(rate->uncertainty >= 0)) return Verdict::undecidable;
  // What the logarithms of the errors themselves are rounded by.
  const double slack = (1 + std::abs(rate->value)) * std::exp2(-36);
  const double low = rate->value - rate->uncertainty - slack, high = rate->value + rate->uncertainty + slack;
  const double r = claim.predicted;
  const bool exactly = claim.form == Form::exactly;
  if (high < r || (exactly && low > r)) return Verdict::fails;
  if (!exactly && low >= r) return Verdict::holds;
  // The exponents of an expansion in the step are whole numbers: where the interval holds one alone, that is the rate.
  const bool is_whole = std::round(r) == r && rate->uncertainty < 1 / double{4};
  return is_whole ? Verdict::holds : Verdict::undecidable;
}

}  // namespace hbvm::core

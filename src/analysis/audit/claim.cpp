#include "hbvm/analysis/audit/claim.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hbvm/error.hpp"

namespace hbvm {
namespace {

constexpr std::array<std::pair<Quantity, std::string_view>, 22> quantities{{
    {Quantity::q, "q"},
    {Quantity::p, "raw p"},
    {Quantity::tangential_p, "tangential p"},
    {Quantity::lagmul, "lagmul"},
    {Quantity::output_lambda, "output lambda"},
    {Quantity::delta_lambda, "delta lambda"},
    {Quantity::polynomials, "u and v"},
    {Quantity::g, "g"},
    {Quantity::hidden, "hidden"},
    {Quantity::H, "H"},
    {Quantity::angular_momentum, "angular momentum"},
    {Quantity::reversal, "reversal"},
    {Quantity::hidden_constant, "hidden constant"},
    {Quantity::hidden_drift, "hidden drift"},
    {Quantity::sweeps, "sweeps"},
    {Quantity::order_conditions, "order conditions"},
    {Quantity::B, "B"},
    {Quantity::C, "C"},
    {Quantity::D, "D"},
    {Quantity::X, "X_s"},
    {Quantity::symmetry, "symmetry"},
    {Quantity::W, "W"},
}};

std::string normalised(std::string_view name) {
  std::string text(name);
  std::replace(text.begin(), text.end(), '_', ' ');
  std::replace(text.begin(), text.end(), '-', ' ');
  return text;
}

}  // namespace

std::string_view name_of(Quantity quantity) {
  for (const auto& [own, name] : quantities)
    if (own == quantity) return name;
  return {};
}

Quantity parse_quantity(std::string_view name) {
  const std::string wanted = normalised(name);
  if (wanted == "p") return Quantity::p;
  std::string known;
  for (const auto& [quantity, own] : quantities) {
    if (normalised(own) == wanted) return quantity;
    known += (known.empty() ? "" : ", ") + std::string(own);
  }
  throw InputError("unknown quantity '" + std::string(name) + "': use one of " + known);
}

std::string_view name_of(Verdict verdict) {
  constexpr std::string_view names[] = {"holds", "fails", "undecidable", "degenerate", "not run"};
  return names[static_cast<int>(verdict)];
}

Claim make_claim(const std::string& label, Quantity quantity, const std::string& problem, Span span, Form form,
                 double predicted) {
  Claim claim;
  claim.label = label;
  claim.quantity = quantity;
  claim.problem = problem;
  claim.span = span;
  claim.form = form;
  claim.predicted = predicted;
  return claim;
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

}  // namespace hbvm

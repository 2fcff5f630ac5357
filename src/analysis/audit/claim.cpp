#include "hbvm/analysis/audit/claim.hpp"

#include <algorithm>
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
  constexpr std::string_view names[] = {"holds", "fails", "undecidable"};
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

std::string Claim::method_text() const {
  if (tableau) return tableau->name;
  return "HBVM(" + std::to_string(method.k) + "," + std::to_string(method.s) + ")";
}

Verdict judge(const Claim& claim, const std::optional<Rate>& rate) {
  if (!rate) return Verdict::undecidable;
  const double half = 1 / double{2};
  const double low = rate->value - rate->uncertainty, high = rate->value + rate->uncertainty;
  const bool exactly = claim.form == Form::exactly;
  if (high < claim.predicted - half || (exactly && low > claim.predicted + half)) return Verdict::fails;
  const bool enough = low > claim.predicted - half;
  return enough && (!exactly || high < claim.predicted + half) ? Verdict::holds : Verdict::undecidable;
}

}  // namespace hbvm

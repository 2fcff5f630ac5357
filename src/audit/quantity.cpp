#include "audit/quantity.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "hbvm/error.hpp"

namespace hbvm::core {
namespace {

constexpr std::array<std::pair<Quantity, std::string_view>, 26> quantities{{
    {Quantity::q, "q"},
    {Quantity::p, "raw p"},
    {Quantity::tangential_p, "tangential p"},
    {Quantity::lagmul, "lagmul"},
    {Quantity::output_lambda, "output lambda"},
    {Quantity::q_between, "q between"},
    {Quantity::p_between, "p between"},
    {Quantity::lambda_between, "lambda between"},
    {Quantity::delta_lambda, "delta lambda"},
    {Quantity::polynomials, "u and v"},
    {Quantity::g, "g"},
    {Quantity::hidden, "hidden"},
    {Quantity::H, "H"},
    {Quantity::balance, "balance"},
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

}  // namespace hbvm::core

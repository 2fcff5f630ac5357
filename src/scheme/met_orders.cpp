#include "scheme/met_orders.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "method/decimals.hpp"
#include "scalar/log2_of.hpp"
#include "scalar/scalar.hpp"

namespace hbvm::core {
namespace {

constexpr unsigned exact_digits = 120, guard = 30;

/// The same numbers with every decimal off by a unit in its last digit, up or down.
std::vector<Mpfr> moved(const std::vector<Mpfr>& values, const Rounding& rounding, std::mt19937& signs) {
  std::vector<Mpfr> result = values;
  const Mpfr unit = pow(Mpfr(10), -rounding.digits);
  for (const std::size_t e : rounding.entries) {
    const Mpfr size = unit * std::max(Mpfr(1), magnitude(result[e]));
    result[e] += signs() % 2 == 0 ? size : Mpfr(-size);
  }
  return result;
}

Mpfr greatest(const std::vector<Mpfr>& numbers) {
  Mpfr most = 0;
  for (const Mpfr& x : numbers) raise_to(most, magnitude(x));
  return most;
}

}  // namespace

Rounding Rounding::of(const Scheme& scheme, std::optional<int> said) {
  std::vector<std::string> numbers;
  Rounding rounding;
  for (std::size_t e = 0; e < scheme.entries().size(); ++e)
    if (const auto& written = scheme.entries()[e].written) {
      numbers.push_back(written->text());
      if (has_decimal(written->text())) rounding.entries.push_back(e);
    }
  if (const std::optional<Decimals> decimals = decimals_of(numbers, said)) rounding.digits = decimals->digits;
  if (rounding.digits == 0) rounding.entries.clear();
  rounding.working_digits = std::max(exact_digits, static_cast<unsigned>(rounding.digits) + guard);
  return rounding;
}

double digits_met(const std::vector<Mpfr>& residuals) {
  const Mpfr most = greatest(residuals);
  const double all = digits10<Mpfr>();
  return most == 0 ? all : std::min(all, -log2_of(most) * std::log10(double(2)));
}

double consistent_digits(const Scheme& scheme, const std::vector<Mpfr>& values) {
  return digits_met(scheme.consistency(values));
}

std::vector<MetPart> met_parts(const Scheme& scheme, const std::vector<Mpfr>& values, const Rounding& rounding) {
  constexpr int patterns = 3, times = 8;
  std::vector<std::vector<Mpfr>> off;
  std::mt19937 signs(1);
  for (int n = 0; n < patterns && !rounding.entries.empty(); ++n) off.push_back(moved(values, rounding, signs));
  const Mpfr round_off = pow(Mpfr(10), static_cast<int>(guard) - static_cast<int>(rounding.working_digits));
  std::vector<MetPart> parts;
  for (std::size_t part = 0; part < scheme.parts().size(); ++part) {
    const SchemePart& what = scheme.parts()[part];
    MetPart found{what.name, what.stated, 0, {}};
    bool all_met = true;
    for (int order = 1; order <= what.max_order && (all_met || order <= what.stated.value_or(0)); ++order) {
      const std::vector<Mpfr> residuals = scheme.residuals(part, order, values);
      Mpfr allowed = round_off;
      for (const std::vector<Mpfr>& other : off) {
        const std::vector<Mpfr> changed = scheme.residuals(part, order, other);
        for (std::size_t r = 0; r < residuals.size(); ++r)
          raise_to(allowed, Mpfr(times * magnitude(Mpfr(changed[r] - residuals[r]))));
      }
      const bool met = greatest(residuals) <= allowed;
      found.each.push_back({order, static_cast<long>(residuals.size()), digits_met(residuals), met});
      all_met = all_met && met;
      if (all_met) found.order = order;
    }
    parts.push_back(std::move(found));
  }
  return parts;
}

}  // namespace hbvm::core

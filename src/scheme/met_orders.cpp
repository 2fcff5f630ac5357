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
  for (const auto& [place, digits] : rounding.entries) {
    const Mpfr size = pow(Mpfr(10), -digits) * std::max(Mpfr(1), magnitude(result[place]));
    result[place] += signs() % 2 == 0 ? size : Mpfr(-size);
  }
  return result;
}

Mpfr greatest(const std::vector<Mpfr>& numbers) {
  Mpfr most = 0;
  for (const Mpfr& x : numbers) raise_to(most, magnitude(x));
  return most;
}

bool is_long_fraction(const std::string& number) {
  constexpr std::ptrdiff_t many = 14;
  return number.find('/') != std::string::npos && number.find('(') == std::string::npos && !has_decimal(number) &&
         std::count_if(number.begin(), number.end(), [](char c) { return c >= '0' && c <= '9'; }) >= many;
}

/// Digits of a plain decimal among others of `digits`. A few less than these may be all that it was printed with.
int own_digits(const std::string& number, int digits) {
  constexpr int few = 5;
  const std::size_t first = number.find_first_not_of("+-0"), point = number.find('.');
  if (first == std::string::npos || point == std::string::npos ||
      number.find_first_not_of("0123456789.", number.find_first_of("+-") == 0 ? 1 : 0) != std::string::npos)
    return digits;
  const std::size_t before = first < point ? point - first - 1 : 0;
  const int own = static_cast<int>(number.size() - point - 1 + before);
  return own < digits && own >= digits - few ? own : digits;
}

}  // namespace

bool Rounding::has_long_fractions(const Scheme& scheme) {
  return std::any_of(scheme.entries().begin(), scheme.entries().end(),
                     [](const SchemeEntry& entry) { return entry.written && is_long_fraction(entry.written->text()); });
}

Rounding Rounding::of(const Scheme& scheme, std::optional<int> said) {
  std::vector<std::string> numbers;
  Rounding rounding;
  for (std::size_t e = 0; e < scheme.entries().size(); ++e)
    if (const auto& written = scheme.entries()[e].written) {
      numbers.push_back(written->text());
      if (said && is_long_fraction(written->text())) {
        rounding.of_fractions = true;
        rounding.entries.push_back({e, *said});
      } else if (has_decimal(written->text())) {
        rounding.entries.push_back({e, 0});
      }
    }
  if (const std::optional<Decimals> decimals = decimals_of(numbers, said)) rounding.digits = decimals->digits;
  if (rounding.of_fractions) rounding.digits = *said;
  if (rounding.digits == 0) rounding.entries.clear();
  for (Entry& entry : rounding.entries)
    if (entry.digits == 0)
      entry.digits = said ? *said : own_digits(scheme.entries()[entry.place].written->text(), rounding.digits);
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
  for (int n = 0; n < patterns && rounding.digits > 0; ++n) off.push_back(moved(values, rounding, signs));
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

#include "method/decimals.hpp"

#include <algorithm>
#include <cctype>
#include <random>
#include <vector>

#include "scalar/literal.hpp"

namespace hbvm::core {
namespace {

/// A number with a point as it is written somewhere in an expression.
struct Written {
  std::string text;
  int significant = 0, places = 0;
};

std::vector<Written> decimals_in(const std::string& text) {
  const auto is_digit = [&](std::size_t i) {
    return i < text.size() && std::isdigit(static_cast<unsigned char>(text[i]));
  };
  std::vector<Written> found;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!is_digit(i) && !(text[i] == '.' && is_digit(i + 1))) continue;
    if (i > 0 && (std::isalnum(static_cast<unsigned char>(text[i - 1])) || text[i - 1] == '_')) continue;
    Written w;
    bool point = false, counts = false;
    std::size_t end = i;
    for (; is_digit(end) || (!point && end < text.size() && text[end] == '.'); ++end) {
      if (text[end] == '.') {
        point = true;
        continue;
      }
      counts = counts || text[end] != '0';
      if (counts) ++w.significant;
      if (point) ++w.places;
    }
    if (end < text.size() && (text[end] == 'e' || text[end] == 'E')) {
      const std::size_t sign =
          end + 1 < text.size() && (text[end + 1] == '-' || text[end + 1] == '+') ? end + 2 : end + 1;
      if (is_digit(sign)) {
        w.places -= std::atoi(text.c_str() + end + 1);
        for (end = sign; is_digit(end);) ++end;
        point = true;
      }
    }
    w.text = text.substr(i, end - i);
    if (point) found.push_back(w);
    i = end - 1;
  }
  return found;
}

template <class F>
void for_each_number(const Tableau& tableau, F f) {
  for (const auto& row : tableau.A)
    for (const Number& x : row) f(x);
  for (const Number& x : tableau.b) f(x);
  for (const Number& x : tableau.c) f(x);
}

bool looks_exact(const Written& w) {
  constexpr int few = 8;
  if (w.significant < few) return true;
  constexpr long halvings = 30;
  const PrecisionScope scope(static_cast<unsigned>(w.significant) + 40);
  Mpfr x = literal<Mpfr>(w.text);
  mpfr_mul_2si(raw(x), raw(x), halvings, MPFR_RNDN);
  return mpfr_integer_p(raw(x)) != 0;
}

/// A fraction with far fewer digits than the number, which is its rounding.
std::optional<std::string> fraction_of(const Written& w) {
  const PrecisionScope scope(static_cast<unsigned>(2 * w.significant) + 40);
  const Mpfr x = literal<Mpfr>(w.text), unit = pow(Mpfr(10), -w.places);
  Mpfr rest = x, p = 1, q = 0, p_before = 0, q_before = 1;
  constexpr int most = 40;
  for (int n = 0; n < most; ++n) {
    const Mpfr whole = floor(rest), p_next = whole * p + p_before, q_next = whole * q + q_before;
    p_before = p;
    q_before = q;
    p = p_next;
    q = q_next;
    // A chance fraction has as many digits in p and q together as the number.
    if (q * q * 10'000 * unit > 1) return std::nullopt;
    if (abs(Mpfr(p / q - x)) <= unit) {
      if (q * x == p) return std::nullopt;  // it is exact
      return p.str(0, std::ios_base::fixed) + (q == 1 ? "" : "/" + q.str(0, std::ios_base::fixed));
    }
    if (rest == whole) return std::nullopt;
    rest = 1 / (rest - whole);
  }
  return std::nullopt;
}

}  // namespace

std::optional<Decimals> decimals_of(const Tableau& tableau) {
  std::vector<std::string> numbers;
  for_each_number(tableau, [&](const Number& x) { numbers.push_back(x.text()); });
  return decimals_of(numbers, tableau.digits);
}

bool has_decimal(const std::string& number) { return !decimals_in(number).empty(); }

std::optional<Decimals> decimals_of(const std::vector<std::string>& numbers, std::optional<int> said) {
  std::vector<Written> rounded, all;
  for (const std::string& number : numbers)
    for (const Written& w : decimals_in(number)) {
      all.push_back(w);
      if (!looks_exact(w)) rounded.push_back(w);
    }
  if (rounded.empty() && !said) return std::nullopt;
  const std::vector<Written>& shown = rounded.empty() ? all : rounded;
  if (shown.empty()) return std::nullopt;
  Decimals result;
  if (said) {
    result.digits = *said;
  } else {
    // From 1/10 to 1, where places and digits are the same; greater ones; any.
    std::vector<int> counts;
    const auto count = [&](const auto& is_counted) {
      if (!counts.empty()) return;
      for (const Written& w : rounded)
        if (is_counted(w)) counts.push_back(w.significant);
    };
    count([](const Written& w) { return w.significant == w.places; });
    count([](const Written& w) { return w.significant > w.places; });
    count([](const Written&) { return true; });
    const auto middle = counts.begin() + static_cast<std::ptrdiff_t>(counts.size() / 2);
    std::nth_element(counts.begin(), middle, counts.end());
    constexpr int of_double = 17;
    result.digits = *middle == of_double ? of_double - 1 : *middle;
  }
  result.example = shown.front().text;
  for (const Written& w : shown)
    if (!result.fraction && (result.fraction = fraction_of(w))) result.example = w.text;
  return result;
}

RungeKutta<Mpfr> off_by_a_unit(const Tableau& tableau, const Decimals& decimals, unsigned pattern) {
  RungeKutta<Mpfr> method = make_runge_kutta<Mpfr>(tableau);
  const Mpfr unit = pow(Mpfr(10), -decimals.digits);
  std::mt19937 signs(pattern);
  const auto move = [&](Mpfr& x, const Number& from) {
    if (!has_decimal(from.text())) return;
    const Mpfr size = std::max(Mpfr(1), magnitude(x));
    if (signs() % 2 == 0)
      x += unit * size;
    else
      x -= unit * size;
  };
  for (Index i = 0; i < method.b.size(); ++i) {
    const auto n = static_cast<std::size_t>(i);
    for (Index j = 0; j < method.b.size(); ++j) move(method.A(i, j), tableau.A[n][static_cast<std::size_t>(j)]);
    move(method.b[i], tableau.b[n]);
    move(method.c[i], tableau.c[n]);
  }
  return method;
}

}  // namespace hbvm::core

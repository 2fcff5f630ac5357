#include "scalar/text.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <memory>

namespace hbvm::core {
namespace {

/// Significant decimal digits d1d2d3… and the exponent e of 0.d1d2d3… x 10^e, as mpfr_get_str gives them.
struct Decimal {
  bool negative = false;
  std::string digits;
  long exponent = 0;
};

Decimal decimal(const BigFloat& x, std::size_t count, mpfr_rnd_t rounding = MPFR_RNDN) {
  mpfr_exp_t exponent = 0;
  const std::unique_ptr<char, void (*)(char*)> text(mpfr_get_str(nullptr, &exponent, 10, count, raw(x), rounding),
                                                    mpfr_free_str);
  std::string digits = text.get();
  const bool negative = digits.front() == '-';
  if (negative) digits.erase(0, 1);
  return {negative, digits, exponent};
}

bool reads_back(const Decimal& d, const BigFloat& x) {
  const std::string text = (d.negative ? "-0." : "0.") + d.digits + "e" + std::to_string(d.exponent);
  BigFloat back(mpfr_get_prec(raw(x)));
  mpfr_set_str(raw(back), text.c_str(), 10, MPFR_RNDN);
  return mpfr_equal_p(raw(back), raw(x)) != 0;
}

/// The fewest digits that read back. If d digits do, so do d + 1, which makes a binary search right. Below powers of
/// two numbers lie denser, so that it takes one more look down. Most numbers need nearly all digits, so that the search
/// starts there.
Decimal shortest(const BigFloat& x) {
  const std::size_t enough = mpfr_get_str_ndigits(10, mpfr_get_prec(raw(x)));
  std::size_t low = 1, high = enough;
  for (std::size_t probe = enough - 1; probe >= 1 && probe + 3 > enough; --probe) {
    if (reads_back(decimal(x, probe), x)) {
      high = probe;
    } else {
      low = probe + 1;
      break;
    }
  }
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (reads_back(decimal(x, middle), x))
      high = middle;
    else
      low = middle + 1;
  }
  if (high > 1)
    for (const mpfr_rnd_t rounding : {MPFR_RNDN, MPFR_RNDU, MPFR_RNDD})
      if (Decimal fewer = decimal(x, high - 1, rounding); reads_back(fewer, x)) return fewer;
  return decimal(x, high);
}

std::string layout(const Decimal& d) {
  std::string digits = d.digits;
  digits.erase(digits.find_last_not_of('0') + 1);
  const long count = static_cast<long>(digits.size());
  const std::string sign = d.negative ? "-" : "";
  constexpr long plain = 16;  // beyond 10^16 and below 10^-4 an exponent reads better than zeros
  if (d.exponent > plain || d.exponent < -3) {
    std::string text = sign + digits.substr(0, 1);
    if (count > 1) text += "." + digits.substr(1);
    return text + "e" + std::to_string(d.exponent - 1);
  }
  if (d.exponent <= 0) return sign + "0." + std::string(static_cast<std::size_t>(-d.exponent), '0') + digits;
  if (count <= d.exponent) return sign + digits + std::string(static_cast<std::size_t>(d.exponent - count), '0');
  return sign + digits.substr(0, static_cast<std::size_t>(d.exponent)) + "." +
         digits.substr(static_cast<std::size_t>(d.exponent));
}

std::string special(const BigFloat& x) {
  if (mpfr_nan_p(raw(x))) return "nan";
  if (mpfr_inf_p(raw(x))) return mpfr_sgn(raw(x)) < 0 ? "-inf" : "inf";
  return "0";
}

std::string text_of(const BigFloat& x) { return mpfr_regular_p(raw(x)) ? layout(shortest(x)) : special(x); }

/// By MPFR's printf. \param format with the number of digits and the number
std::string printed(const BigFloat& x, const char* format, int digits) {
  if (!mpfr_number_p(raw(x))) return special(x);
  char* text = nullptr;
  mpfr_asprintf(&text, format, digits, raw(x));
  const std::unique_ptr<char, void (*)(char*)> owner(text, mpfr_free_str);
  return text;
}

std::string scientific(const BigFloat& x, int digits) { return printed(x, "%.*Re", digits - 1); }

/// The number of a text, right to its own digits and to as many as are to be printed, if those are more.
BigFloat number_of(const std::string& decimal, int digits) {
  constexpr long bits_a_digit = 4, spare = 64;
  BigFloat x(std::max(static_cast<long>(decimal.size()), static_cast<long>(digits)) * bits_a_digit + spare);
  mpfr_set_str(raw(x), decimal.c_str(), 10, MPFR_RNDN);
  return x;
}

}  // namespace

std::string to_text(const Mpfr& x) { return text_of(exactly(x)); }
#if HBVM_QUAD
std::string to_text(const Quad& x) { return text_of(exactly(x)); }
#endif

std::string to_text(double x) {
  if (x != x || x - x != 0 || x == 0) return special(exactly(x));
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, x, std::chars_format::scientific).ptr;
  const std::string text(buffer, end);
  const std::size_t e = text.find('e');
  Decimal d;
  d.negative = text.front() == '-';
  for (const char c : text.substr(0, e))
    if (c >= '0' && c <= '9') d.digits += c;
  d.exponent = std::strtol(text.c_str() + e + 1, nullptr, 10) + 1;
  return layout(d);
}

std::string to_scientific(const Mpfr& x, int digits) { return scientific(exactly(x), digits); }
#if HBVM_QUAD
std::string to_scientific(const Quad& x, int digits) { return scientific(exactly(x), digits); }
#endif
std::string to_scientific(double x, int digits) { return scientific(exactly(x), digits); }
std::string to_scientific(const std::string& decimal, int digits) {
  return scientific(number_of(decimal, digits), digits);
}

bool is_decimal(const std::string& text) {
  std::size_t i = text.starts_with('-') ? 1 : 0, digits = 0, points = 0;
  for (; i < text.size() && (std::isdigit(static_cast<unsigned char>(text[i])) != 0 || text[i] == '.'); ++i)
    (text[i] == '.' ? points : digits) += 1;
  if (digits == 0 || points > 1) return false;
  if (i == text.size()) return true;
  if (text[i] != 'e' && text[i] != 'E') return false;
  ++i;
  if (i < text.size() && (text[i] == '-' || text[i] == '+')) ++i;
  return i < text.size() && std::all_of(text.begin() + static_cast<std::ptrdiff_t>(i), text.end(),
                                        [](unsigned char c) { return std::isdigit(c) != 0; });
}

std::string rounded_text(const std::string& decimal, int digits) {
  const BigFloat x = number_of(decimal, digits);
  if (!mpfr_regular_p(raw(x))) return special(x);
  std::string text = printed(x, "%#.*Rg", digits);
  // C's alternative form ends a whole number with its point.
  if (text.ends_with('.')) text.pop_back();
  const std::size_t exponent = text.find(".e");
  return exponent == std::string::npos ? text : text.erase(exponent, 1);
}

}  // namespace hbvm::core

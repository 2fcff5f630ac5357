#pragma once

// What hbvm uses of C++20's library and the one of Debian's emscripten has not. It is read before every source.

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <string>
#include <utility>

#if _LIBCPP_VERSION < 14000

namespace std {

namespace ranges {

template <class Range, class F>
constexpr bool any_of(Range&& range, F f) {
  return std::any_of(std::begin(range), std::end(range), std::move(f));
}
template <class Range, class F>
constexpr bool all_of(Range&& range, F f) {
  return std::all_of(std::begin(range), std::end(range), std::move(f));
}
template <class Range, class F>
constexpr auto find_if(Range&& range, F f) {
  return std::find_if(std::begin(range), std::end(range), std::move(f));
}
template <class Range, class F>
constexpr void for_each(Range&& range, F f) {
  std::for_each(std::begin(range), std::end(range), std::move(f));
}
template <class Range, class T>
constexpr auto count(Range&& range, const T& value) {
  return std::count(std::begin(range), std::end(range), value);
}
template <class Range, class T>
constexpr auto lower_bound(Range&& range, const T& value) {
  return std::lower_bound(std::begin(range), std::end(range), value);
}
template <class Range, class T>
constexpr void fill(Range&& range, const T& value) {
  std::fill(std::begin(range), std::end(range), value);
}
template <class Range>
constexpr void sort(Range&& range) {
  std::sort(std::begin(range), std::end(range));
}
template <class Range>
constexpr void reverse(Range&& range) {
  std::reverse(std::begin(range), std::end(range));
}
template <class One, class Other, class Same = std::equal_to<>>
constexpr bool equal(One&& one, Other&& other, Same same = {}) {
  return std::equal(std::begin(one), std::end(one), std::begin(other), std::end(other), std::move(same));
}

}  // namespace ranges

/// The shortest decimal that reads back as x, or all of its bits.
inline to_chars_result to_chars(char* first, char* last, double x, chars_format format) {
  const auto room = static_cast<std::size_t>(last - first);
  char text[64];
  int length = 0;
  if (format == chars_format::hex) {
    length = std::snprintf(text, sizeof text, "%a", x);
    std::string digits(text, static_cast<std::size_t>(length));
    if (const auto x_at = digits.find("0x"); x_at != std::string::npos) digits.erase(x_at, 2);
    length = static_cast<int>(digits.copy(text, sizeof text));
  } else {
    for (int digits = 0; digits <= 16; ++digits) {
      length = std::snprintf(text, sizeof text, "%.*e", digits, x);
      if (std::strtod(text, nullptr) == x) break;
    }
  }
  if (static_cast<std::size_t>(length) > room) return {last, errc::value_too_large};
  return {std::copy_n(text, length, first), errc{}};
}

inline from_chars_result from_chars(const char* first, const char* last, double& x,
                                    chars_format format = chars_format::general) {
  std::string text(first, last);
  const bool negative = !text.empty() && text.front() == '-';
  if (format == chars_format::hex) text.insert(negative ? 1 : 0, "0x");
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (end == text.c_str()) return {first, errc::invalid_argument};
  x = value;
  return {first + (end - text.c_str()) - (format == chars_format::hex ? 2 : 0), errc{}};
}

}  // namespace std

#endif

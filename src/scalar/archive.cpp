#include "scalar/archive.hpp"

#include <charconv>
#include <memory>

#include "hbvm/error.hpp"

namespace hbvm::core {
namespace {

std::string hexadecimal(mpfr_srcptr x) {
  char* text = nullptr;
  mpfr_asprintf(&text, "%Ra", x);
  const std::unique_ptr<char, void (*)(char*)> owner(text, mpfr_free_str);
  return text;
}

/// \return whether the text was a number
bool set_to_hexadecimal(mpfr_ptr x, std::string_view text) {
  const std::string copy(text);
  char* end = nullptr;
  // Nothing is rounded: the text has no more bits than x.
  return mpfr_strtofr(x, copy.c_str(), &end, 0, MPFR_RNDN) == 0 && end != copy.c_str() && *end == '\0';
}

}  // namespace

void Archive::refuse(const std::string& why) {
  throw InputError("a remembered state does not fit this program: " + why);
}

void Archive::expect_end() const {
  if (at_ != text_.size()) refuse("it holds more values");
}

void Archive::write(std::string_view token) {
  text_ += token;
  text_ += '\n';
}

std::string_view Archive::read() {
  const std::size_t end = text_.find('\n', at_);
  if (end == std::string::npos) refuse("it holds fewer values");
  const auto token = std::string_view(text_).substr(at_, end - at_);
  at_ = end + 1;
  return token;
}

template <class Integer>
void Archive::keep_integer(Integer& x) {
  if (!reading_) return write(std::to_string(x));
  const std::string_view token = read();
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), x);
  if (error != std::errc() || end != token.data() + token.size())
    refuse("'" + std::string(token) + "' is no whole number");
}

void Archive::keep(int& x) { keep_integer(x); }
void Archive::keep(long& x) { keep_integer(x); }
void Archive::keep(std::uint64_t& x) { keep_integer(x); }

void Archive::keep(bool& x) {
  int number = x ? 1 : 0;
  keep_integer(number);
  x = number != 0;
}

void Archive::keep(double& x) {
  if (!reading_) {
    char buffer[40];
    const auto end = std::to_chars(buffer, buffer + sizeof buffer, x, std::chars_format::hex).ptr;
    return write({buffer, static_cast<std::size_t>(end - buffer)});
  }
  const std::string_view token = read();
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), x, std::chars_format::hex);
  if (error != std::errc() || end != token.data() + token.size()) refuse("'" + std::string(token) + "' is no number");
}

#if HBVM_QUAD
void Archive::keep(Quad& x) {
  if (!reading_) return write(hexadecimal(raw(exactly(x))));
  const std::string_view token = read();
  BigFloat value(significand_bits<Quad>());
  if (!set_to_hexadecimal(raw(value), token)) refuse("'" + std::string(token) + "' is no number");
  x = rounded_to<Quad>(raw(value));
}
#endif

void Archive::keep(Mpfr& x) {
  auto bits = static_cast<long>(mpfr_get_prec(raw(x)));
  keep_integer(bits);
  if (!reading_) return write(hexadecimal(raw(x)));
  const std::string_view token = read();
  if (bits < MPFR_PREC_MIN || bits > MPFR_PREC_MAX) refuse("no number has " + std::to_string(bits) + " bits");
  if (bits != mpfr_get_prec(raw(x))) mpfr_set_prec(raw(x), bits);
  if (!set_to_hexadecimal(raw(x), token)) refuse("'" + std::string(token) + "' is no number");
}

void Archive::keep(std::string& x) {
  auto size = static_cast<long>(x.size());
  keep_integer(size);
  if (!reading_) return write(x);
  const std::size_t end = at_ + static_cast<std::size_t>(size);
  if (size < 0 || end >= text_.size() || text_[end] != '\n') refuse("a text is cut off");
  x = text_.substr(at_, static_cast<std::size_t>(size));
  at_ = end + 1;
}

}  // namespace hbvm::core

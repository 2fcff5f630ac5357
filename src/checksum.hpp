#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace hbvm::core {

/// FNV-1a in 64 bits: no change of one byte goes unnoticed, other damage but once in 2^64. No protection from intent.
class Checksum {
 public:
  Checksum() = default;
  explicit Checksum(std::string_view bytes) { add(bytes); }

  void add(std::string_view bytes) {
    constexpr std::uint64_t prime = 1'099'511'628'211U;
    for (const char c : bytes) value_ = (value_ ^ static_cast<unsigned char>(c)) * prime;
  }

  /// 16 hexadecimal digits.
  std::string text() const {
    std::string digits;
    for (int shift = 60; shift >= 0; shift -= 4) digits += "0123456789abcdef"[value_ >> shift & 15U];
    return digits;
  }
  friend bool operator==(const Checksum&, const Checksum&) = default;

 private:
  std::uint64_t value_ = 14'695'981'039'346'656'037U;
};

}  // namespace hbvm::core

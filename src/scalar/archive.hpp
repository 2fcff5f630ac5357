#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scalar/scalar.hpp"

namespace hbvm::core {

/// Exact values as text, in order. The same calls write and read, so that the two cannot disagree: what has a state
/// says so once, in a member
///
///     void remember(Archive& archive) { archive(q_, p_, extrapolation_); }
///
/// and an archive that writes appends these values, one that reads replaces them. Numbers are hexadecimal and keep
/// every bit, infinities, NaN and the sign of zero; an Mpfr keeps its own precision. What can be recomputed from the
/// rest to the last bit need not be remembered.
class Archive {
 public:
  /// Writes.
  Archive() = default;
  /// Reads what another one wrote.
  explicit Archive(std::string text) : reading_(true), text_(std::move(text)) {}

  bool reading() const { return reading_; }
  const std::string& text() const { return text_; }

  /// Numbers, texts, matrices and vectors of fixed size, and whatever has a member remember(Archive&).
  /// \throws InputError if a value read is none, or the size of a container is another
  template <class... T>
  void operator()(T&... values) {
    (keep(values), ...);
  }

  /// A vector that becomes as long as it was.
  /// \throws InputError as above
  template <class T>
  void sized(std::vector<T>& values) {
    auto size = static_cast<long>(values.size());
    keep(size);
    if (size < 0 || (reading_ && static_cast<std::size_t>(size) > text_.size() - at_)) refuse("a size is wrong");
    values.resize(static_cast<std::size_t>(size));
    for (T& value : values) keep(value);
  }

  /// \throws InputError if something is left to be read
  void expect_end() const;

 private:
  void keep(bool& x);
  void keep(int& x);
  void keep(long& x);
  void keep(std::uint64_t& x);
  void keep(double& x);
  void keep(Quad& x);
  void keep(Mpfr& x);
  void keep(std::string& x);

  template <class T>
  requires requires(T& x, Archive& archive) { x.remember(archive); }
  void keep(T& x) { x.remember(*this); }
  template <class T>
  requires requires(T& x) { x.data()[x.size() - 1]; }
  void keep(T& values) {
    auto size = static_cast<long>(values.size());
    keep(size);
    if (size != static_cast<long>(values.size())) refuse("a size is another");
    for (long i = 0; i < size; ++i) keep(values.data()[i]);
  }

  template <class Integer>
  void keep_integer(Integer& x);
  void write(std::string_view token);
  std::string_view read();
  [[noreturn]] static void refuse(const std::string& why);

  bool reading_ = false;
  std::string text_;
  std::size_t at_ = 0;  ///< read so far
};

}  // namespace hbvm::core

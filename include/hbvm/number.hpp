#pragma once

#include <string>
#include <vector>

namespace hbvm {

/// An exact number as text, which the library rounds once, in the precision of a run: "3/5", "0.1", "2^(3/4)*pi/40".
/// Whole numbers and doubles stand for their shortest decimal, so that 0.1 is 1/10.
class Number {
 public:
  Number(const char* text) : text_(text) {}
  Number(std::string text) : text_(std::move(text)) {}
  Number(int value) : Number(static_cast<long>(value)) {}
  Number(long value);
  /// \throws InputError if the value is not finite
  Number(double value);

  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// What the number is, rounded once in a precision: decimal text that reads back exactly.
/// \throws InputError if it has no value
std::string decimal(const Number& number, const std::string& precision = "double");

using Numbers = std::vector<Number>;      ///< a vector
using NumberRows = std::vector<Numbers>;  ///< a matrix, row by row

}  // namespace hbvm

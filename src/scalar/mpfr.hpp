#pragma once

#include <boost/multiprecision/mpfr.hpp>
#include <string>

namespace hbvm::core {

/// Binary floating point with a number of digits chosen at run time: Boost's number over mpfr_t, without
/// expression templates. New values take the digits of the innermost PrecisionScope of their thread.
using Mpfr = boost::multiprecision::number<boost::multiprecision::mpfr_float_backend<0>, boost::multiprecision::et_off>;

/// The mpfr_t inside, for in-place arithmetic.
inline mpfr_ptr raw(Mpfr& x) { return x.backend().data(); }
inline mpfr_srcptr raw(const Mpfr& x) { return x.backend().data(); }

/// Significand bits that new values of this thread have.
inline int mpfr_working_bits() {
  return static_cast<int>(
      boost::multiprecision::detail::digits10_2_2(static_cast<unsigned long>(Mpfr::thread_default_precision())));
}

/// For as long as it lives, new Mpfr values of this thread have `digits` decimal digits, and an assignment keeps
/// the digits of its target. Keep one precision per scope, and open one in every worker thread: a new thread
/// starts at Boost's default, not at its parent's digits.
class PrecisionScope {
 public:
  explicit PrecisionScope(unsigned digits)
      : digits_(Mpfr::thread_default_precision()), options_(Mpfr::thread_default_variable_precision_options()) {
    Mpfr::thread_default_precision(digits);
    Mpfr::thread_default_variable_precision_options(
        boost::multiprecision::variable_precision_options::preserve_target_precision);
  }
  ~PrecisionScope() {
    Mpfr::thread_default_precision(digits_);
    Mpfr::thread_default_variable_precision_options(options_);
  }
  PrecisionScope(const PrecisionScope&) = delete;
  PrecisionScope& operator=(const PrecisionScope&) = delete;

 private:
  unsigned digits_;
  boost::multiprecision::variable_precision_options options_;
};

}  // namespace hbvm::core

// A double beside a number of many digits is nearly always a literal that is wrong after the 17th digit, so it does
// not compile. (Integers are exact and stay allowed.) The overloads must stand in Boost's namespace to be found.
#define HBVM_FORBID_OPERATOR(Result, Number, Binary, op) \
  Result operator op(const Number&, Binary) = delete;    \
  Result operator op(Binary, const Number&) = delete;
#define HBVM_FORBID_UPDATE(Number, Binary, op) Number& operator op(Number&, Binary) = delete;
#define HBVM_FORBID_BINARY(Number, Binary)        \
  HBVM_FORBID_OPERATOR(Number, Number, Binary, +) \
  HBVM_FORBID_OPERATOR(Number, Number, Binary, -) \
  HBVM_FORBID_OPERATOR(Number, Number, Binary, *) \
  HBVM_FORBID_OPERATOR(Number, Number, Binary, /) \
  HBVM_FORBID_OPERATOR(bool, Number, Binary, <)   \
  HBVM_FORBID_OPERATOR(bool, Number, Binary, >)   \
  HBVM_FORBID_OPERATOR(bool, Number, Binary, <=)  \
  HBVM_FORBID_OPERATOR(bool, Number, Binary, >=)  \
  HBVM_FORBID_UPDATE(Number, Binary, +=)          \
  HBVM_FORBID_UPDATE(Number, Binary, -=)          \
  HBVM_FORBID_UPDATE(Number, Binary, *=)          \
  HBVM_FORBID_UPDATE(Number, Binary, /=)

namespace boost::multiprecision {
HBVM_FORBID_BINARY(hbvm::core::Mpfr, float)
HBVM_FORBID_BINARY(hbvm::core::Mpfr, double)
HBVM_FORBID_BINARY(hbvm::core::Mpfr, long double)
}  // namespace boost::multiprecision

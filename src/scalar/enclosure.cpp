// The value of an Expression by interval arithmetic. Every operation rounds its lower bound down and its upper bound
// up, so that the truth lies between them whatever the cancellation.

#include <algorithm>
#include <optional>

#include "expression_node.hpp"
#include "scalar/expression.hpp"

namespace hbvm::core {

using Node = Expression::Node;
using Kind = Node::Kind;

namespace {

struct Interval {
  BigFloat low, high;
};

/// The bounds are too far apart for this operation; more working digits may help.
struct Undecided {
  const char* reason;
};

constexpr long max_exponent = 131'072;  // of values: an argument of this size takes that many bits of pi
constexpr long min_exponent = -1'000'000'000;
constexpr int max_depth = 700;  // of nodes, those of constants included: no stack may overflow

}  // namespace

class Encloser {
 public:
  /// An argument between bounds that hold 0 counts as 0 if they have become narrow, or with `last` set. What then has
  /// no value is an error. Narrow is below 2^-2N, for a result of N bits and from 4 N working bits on.
  /// \param work bits of results that may still be computed
  Encloser(const Constants& constants, long bits, int target_bits, bool last, long& work)
      : constants_(constants),
        work_(work),
        bits_(bits),
        narrow_exponent_(bits >= 4L * target_bits ? -2L * target_bits : min_exponent),
        last_(last) {}

  bool counts_as_zero(const Interval& a) const {
    if (!holds_zero(a)) return false;
    return last_ || (is_below(a.low, narrow_exponent_) && is_below(a.high, narrow_exponent_));
  }

  Interval value(const Expression& expression) { return value(*expression.root_); }

 private:
  Interval fresh() const { return {BigFloat(bits_), BigFloat(bits_)}; }

  Interval value(const Node& node) {
    if (++depth_ > max_depth) throw ExpressionError("the expression and its constants are nested too deeply");
    work_ -= bits_ * share_of_work(node.kind) / 16;
    if (work_ < 0) throw ExpressionError("takes too many operations in too many digits");
    Interval result = operation(node);
    --depth_;
    const bool low_far = is_too_large(result.low), high_far = is_too_large(result.high);
    if (low_far || high_far) {
      // One bound alone may be far away because the bounds are still wide.
      if (low_far != high_far && !last_) throw Undecided{"value that may be too large"};
      throw ExpressionError("a value beyond 2^131072 comes up");
    }
    return result;
  }

  /// Of the time of a sine, in sixteenths.
  static long share_of_work(Kind kind) {
    switch (kind) {
      case Kind::sin:
      case Kind::cos:
      case Kind::exp:
      case Kind::log:
      case Kind::sinh:
      case Kind::cosh:
      case Kind::tanh:
      case Kind::asin:
      case Kind::acos:
      case Kind::atan:
      case Kind::atan2:
        return 16;
      case Kind::tan:
        return 32;
      case Kind::power:
        return 64;
      case Kind::multiply:
      case Kind::divide:
      case Kind::sqrt:
        return 1;
      default:
        return 0;
    }
  }

  static bool is_too_large(const BigFloat& x) { return !mpfr_number_p(raw(x)) || !is_below(x, max_exponent); }

  static bool is_below(const BigFloat& x, long exponent) {
    return !mpfr_regular_p(raw(x)) || mpfr_get_exp(raw(x)) <= exponent;
  }

  Interval operation(const Node& node) {
    if (node.kind == Kind::name) return named(node.text);
    if (node.kind == Kind::decimal)
      return growing([&](mpfr_ptr x, mpfr_rnd_t to) { mpfr_set_str(x, node.text.c_str(), 10, to); });
    if (node.kind == Kind::pi) return growing(mpfr_const_pi);
    Interval a = value(*node.left);
    const std::optional<Interval> right = node.right ? std::optional(value(*node.right)) : std::nullopt;
    switch (node.kind) {
      case Kind::negate:
        return negative(a);
      case Kind::add:
        return growing(mpfr_add, a, *right);
      case Kind::subtract:
        return growing(mpfr_add, a, negative(*right));
      case Kind::multiply:
        return corners(a, *right, mpfr_mul);
      case Kind::divide:
        if (holds_zero(*right)) no_value(*right, "division by 0");
        return corners(a, *right, mpfr_div);
      case Kind::power:
        return power(a, *right);
      case Kind::sqrt:
        if (mpfr_sgn(raw(a.high)) < 0) throw ExpressionError("square root of a negative number");
        if (mpfr_sgn(raw(a.low)) < 0) take_for_zero(a, "square root of a number near 0");
        return growing(mpfr_sqrt, a);
      case Kind::exp:
        return growing(mpfr_exp, a);
      case Kind::log:
        if (mpfr_sgn(raw(a.high)) <= 0) throw ExpressionError("logarithm of a number that is not positive");
        if (mpfr_sgn(raw(a.low)) <= 0) no_value(a, "logarithm of 0");
        return growing(mpfr_log, a);
      case Kind::sin:
        return lipschitz(a, mpfr_sin);
      case Kind::cos:
        return lipschitz(a, mpfr_cos);
      case Kind::tan: {
        const Interval c = lipschitz(a, mpfr_cos);
        if (holds_zero(c)) no_value(c, "tangent of a right angle");
        return corners(lipschitz(a, mpfr_sin), c, mpfr_div);
      }
      case Kind::sinh:
        return growing(mpfr_sinh, a);
      case Kind::cosh:
        return growing(mpfr_cosh, magnitude(a));  // cosh a = cosh |a|
      case Kind::tanh:
        return growing(mpfr_tanh, a);
      case Kind::asin:
        take_for_one(a);
        return growing(mpfr_asin, a);
      case Kind::acos: {
        take_for_one(a);
        std::swap(a.low, a.high);
        return growing(mpfr_acos, a);
      }
      case Kind::atan:
        return growing(mpfr_atan, a);
      case Kind::atan2:
        return angle(a, *right);
      case Kind::abs:
        return magnitude(a);
      default:
        break;
    }
    throw ExpressionError("unknown operation");
  }

  Interval named(const std::string& name) {
    const auto known = constants_.find(name);
    if (known == constants_.end()) throw ExpressionError("unknown name '" + name + "'");
    const auto [entry, fresh_entry] = values_.try_emplace(name);
    if (fresh_entry) entry->second = value(known->second);
    if (!entry->second) throw ExpressionError("the constant '" + name + "' is defined by itself");
    return *entry->second;
  }

  static bool holds_zero(const Interval& a) { return mpfr_sgn(raw(a.low)) <= 0 && mpfr_sgn(raw(a.high)) >= 0; }
  static bool is_point(const Interval& a) { return mpfr_equal_p(raw(a.low), raw(a.high)) != 0; }

  [[noreturn]] void no_value(const Interval& a, const char* reason) const {
    if (counts_as_zero(a)) throw ExpressionError(reason);
    throw Undecided{reason};
  }

  /// The bounds reach below 0, where the operation has no value: at the last attempt the argument counts as 0.
  void take_for_zero(Interval& a, const char* reason) const {
    if (!counts_as_zero(a)) throw Undecided{reason};
    mpfr_set_zero(raw(a.low), 1);
  }

  /// The bounds reach beyond 1 or -1, where there is no arc sine and cosine: what they exceed it by may be rounding.
  void take_for_one(Interval& a) const {
    for (const long end : {1L, -1L}) {
      Interval beyond = fresh();
      mpfr_sub_si(raw(beyond.low), raw(a.low), end, MPFR_RNDD);
      mpfr_sub_si(raw(beyond.high), raw(a.high), end, MPFR_RNDU);
      if (end < 0) beyond = negative(beyond);
      if (mpfr_sgn(raw(beyond.high)) <= 0) continue;
      const char* const reason = "arc sine or cosine of a number beyond 1";
      if (mpfr_sgn(raw(beyond.low)) > 0) throw ExpressionError(reason);
      if (!counts_as_zero(beyond)) throw Undecided{reason};
      mpfr_set_si(raw(end > 0 ? a.high : a.low), end, MPFR_RNDN);
    }
  }

  /// The angle of (x, y). It is monotone in x and in y off the half line y = 0, x <= 0.
  Interval angle(const Interval& y, const Interval& x) const {
    if (holds_zero(y) && mpfr_sgn(raw(x.low)) <= 0) {
      const char* const reason = "angle of a point at 0 or near y = 0, x < 0";
      if (!counts_as_zero(y)) throw Undecided{reason};
      if (holds_zero(x)) no_value(x, "angle of the point 0");
      if (mpfr_sgn(raw(x.high)) > 0) throw Undecided{reason};
      return growing(mpfr_const_pi);
    }
    return corners(y, x, mpfr_atan2);
  }

  /// Bounds of an f that grows with each argument.
  template <class F, class... Argument>
  Interval growing(F f, const Argument&... a) const {
    Interval r = fresh();
    f(raw(r.low), raw(a.low)..., MPFR_RNDD);
    f(raw(r.high), raw(a.high)..., MPFR_RNDU);
    return r;
  }

  /// -a, with nothing rounded.
  static Interval negative(Interval a) {
    mpfr_neg(raw(a.low), raw(a.low), MPFR_RNDN);
    mpfr_neg(raw(a.high), raw(a.high), MPFR_RNDN);
    std::swap(a.low, a.high);
    return a;
  }

  static Interval magnitude(Interval a) {
    if (mpfr_sgn(raw(a.low)) >= 0) return a;
    Interval opposite = negative(a);
    if (mpfr_sgn(raw(a.high)) <= 0) return opposite;
    mpfr_set_zero(raw(a.low), 1);
    mpfr_max(raw(a.high), raw(a.high), raw(opposite.high), MPFR_RNDN);
    return a;
  }

  /// sin and cos at the middle of a, give or take half its width.
  template <class F>
  Interval lipschitz(const Interval& a, F f) const {
    Interval r = fresh();
    BigFloat middle(bits_), radius(bits_);
    mpfr_add(raw(middle), raw(a.low), raw(a.high), MPFR_RNDN);
    mpfr_div_2ui(raw(middle), raw(middle), 1, MPFR_RNDN);
    mpfr_sub(raw(r.low), raw(middle), raw(a.low), MPFR_RNDU);
    mpfr_sub(raw(r.high), raw(a.high), raw(middle), MPFR_RNDU);
    mpfr_max(raw(radius), raw(r.low), raw(r.high), MPFR_RNDU);
    f(raw(r.low), raw(middle), MPFR_RNDD);
    f(raw(r.high), raw(middle), MPFR_RNDU);
    mpfr_sub(raw(r.low), raw(r.low), raw(radius), MPFR_RNDD);
    mpfr_add(raw(r.high), raw(r.high), raw(radius), MPFR_RNDU);
    return r;
  }

  /// Bounds of f over a x b for an f that is monotone in each argument: its extremes lie at the corners.
  template <class F>
  Interval corners(const Interval& a, const Interval& b, F f) const {
    Interval r = fresh();
    BigFloat probe(bits_);
    bool first = true;
    for (const BigFloat* x : {&a.low, &a.high}) {
      for (const BigFloat* y : {&b.low, &b.high}) {
        f(raw(probe), raw(*x), raw(*y), MPFR_RNDD);
        if (first || mpfr_less_p(raw(probe), raw(r.low))) mpfr_set(raw(r.low), raw(probe), MPFR_RNDD);
        f(raw(probe), raw(*x), raw(*y), MPFR_RNDU);
        if (first || mpfr_greater_p(raw(probe), raw(r.high))) mpfr_set(raw(r.high), raw(probe), MPFR_RNDU);
        first = false;
      }
    }
    return r;
  }

  Interval power(Interval a, const Interval& b) const {
    const bool whole = is_point(b) && mpfr_integer_p(raw(b.low));
    if (whole && mpfr_zero_p(raw(b.low))) {
      return growing([](mpfr_ptr x, mpfr_rnd_t to) { mpfr_set_ui(x, 1, to); });
    }
    if (mpfr_sgn(raw(a.low)) > 0) return corners(a, b, mpfr_pow);
    if (whole && mpfr_sgn(raw(a.high)) < 0) {
      Interval r = corners(negative(a), b, mpfr_pow);
      return is_odd(b.low) ? negative(r) : r;
    }
    if (mpfr_sgn(raw(a.high)) < 0) {
      if (last_ || !holds_whole_number(b))
        throw ExpressionError("power of a negative number with an exponent that is not whole");
      throw Undecided{"exponent that may be whole"};
    }
    // The base may be 0.
    if (mpfr_sgn(raw(b.low)) <= 0) no_value(a, "0 to a power that is not positive");
    if (mpfr_sgn(raw(a.low)) < 0) take_for_zero(a, "power of a number near 0");
    return corners(a, b, mpfr_pow);
  }

  static bool holds_whole_number(const Interval& b) {
    BigFloat next(mpfr_get_prec(raw(b.low)));
    mpfr_ceil(raw(next), raw(b.low));
    return mpfr_lessequal_p(raw(next), raw(b.high)) != 0;
  }

  static bool is_odd(const BigFloat& whole) {
    BigFloat half(mpfr_get_prec(raw(whole)));
    mpfr_div_2ui(raw(half), raw(whole), 1, MPFR_RNDN);
    return mpfr_integer_p(raw(half)) == 0;
  }

  const Constants& constants_;
  long& work_;
  long bits_;
  long narrow_exponent_;
  bool last_;
  int depth_ = 0;
  std::map<std::string, std::optional<Interval>, std::less<>> values_;
};

namespace {

/// Both bounds rounded to `bits`; nothing if they differ.
std::optional<BigFloat> common_rounding(const Interval& a, int bits) {
  BigFloat low(bits), high(bits);
  mpfr_set(raw(low), raw(a.low), MPFR_RNDN);
  mpfr_set(raw(high), raw(a.high), MPFR_RNDN);
  if (!mpfr_equal_p(raw(low), raw(high))) return std::nullopt;
  return low;
}

/// The bounds agree in far more than `bits` bits.
bool is_narrow(const Interval& a, int bits) {
  BigFloat width(32);
  mpfr_sub(raw(width), raw(a.high), raw(a.low), MPFR_RNDU);
  return mpfr_zero_p(raw(width)) ||
         (mpfr_regular_p(raw(a.low)) && mpfr_get_exp(raw(width)) < mpfr_get_exp(raw(a.low)) - 8L * bits);
}

}  // namespace

BigFloat Expression::evaluate_to_bits(int bits, const Constants& constants) const {
  // Enough to see every digit of the largest value, and N more of the smallest part of it.
  const long most_bits = 4L * bits + 2 * max_exponent;
  // For thousands of operations in a few times the digits asked for, or some in as many as the largest value has.
  long work = 10'000L * bits + (1L << 21);
  try {
    for (long guard = 32;; guard *= 2) {
      const long working = bits + guard;
      const bool last = working >= most_bits;
      Encloser encloser(constants, working, bits, last, work);
      try {
        const Interval bounds = encloser.value(*this);
        if (const auto value = common_rounding(bounds, bits)) return *value;
        BigFloat middle(bits);
        if (encloser.counts_as_zero(bounds)) {
          mpfr_set_zero(raw(middle), 1);
          return middle;
        }
        // Not 0, yet the bounds round apart however many digits: the truth is half way between two numbers, and either
        // will do.
        if (last || (working > 16L * bits && is_narrow(bounds, bits))) {
          BigFloat exact_middle(working + 2);
          mpfr_add(raw(exact_middle), raw(bounds.low), raw(bounds.high), MPFR_RNDN);
          mpfr_div_2ui(raw(middle), raw(exact_middle), 1, MPFR_RNDN);
          return middle;
        }
      } catch (const Undecided&) {
        // Thrown only before the last attempt: go on with more digits.
      }
    }
  } catch (const ExpressionError& error) {
    throw ExpressionError(text_, error.reason());
  }
}

}  // namespace hbvm::core
